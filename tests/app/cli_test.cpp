// The program as a user meets it: exit codes, messages, files, interruption.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>

#include "app/json/json_value.hpp"
#include "tests/app/program.hpp"
#include "tests/app/running.hpp"

namespace blendwright::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

fs::path source() { return BLENDWRIGHT_SOURCE_DIR; }
std::string example(const std::string& name) {
  return quoted_path(source() / "examples/specs" / (name + ".json"));
}
/// Files without clock readings, whatever the date.
const std::string fixed_date = "SOURCE_DATE_EPOCH=1700000000";

std::size_t widest(const std::string& text) {
  std::size_t best = 0, at = 0;
  for (std::size_t i = 0; i <= text.size(); ++i)
    if (i == text.size() || text[i] == '\n') {
      best = std::max(best, i - at);
      at = i + 1;
    }
  return best;
}

TEST(Program, SaysItsVersionAndHelpsWithAnExamplePerVerb) {
  EXPECT_THAT(run_program("--version").out, HasSubstr("blendwright "));
  const Outcome help = run_program("--help");
  EXPECT_EQ(help.code, 0);
  for (const char* verb :
       {"blend", "verify", "mesh", "eval", "offset", "relate", "collide", "inspect", "list", "schema"}) {
    EXPECT_THAT(help.out, HasSubstr(std::string("  blendwright ") + verb + " "));
    const Outcome own = run_program(std::string(verb) + " --help");
    EXPECT_EQ(own.code, 0);
    EXPECT_THAT(own.out, AllOf(testing::ContainsRegex("Examples?:"),
                               HasSubstr(std::string("blendwright ") + verb + " ")));
  }
}

TEST(Program, RefusesWrongUsageWithCode2AndNothingOnStandardOutput) {
  for (const char* arguments : {"",
                                "blnd x.json",
                                "blend",
                                "blend x.json --format iges",
                                "blend x.json --threads 0",
                                "list surfaces",
                                "blend x.json -o ''",
                                "verify x.json --times",
                                "schema",
                                "schema all",
                                "verify x.json --tol-position -1",
                                "verify x.json --tol-angle-deg nan?",
                                "blend x.json --no-such-flag",
                                "inspect",
                                "mesh",
                                "mesh x.json --cell 0",
                                "mesh x.json --cells 0",
                                "mesh x.json --cell 1 --cells 8",
                                "mesh x.json --box 0,0,0,1,1",
                                "mesh x.json --box 0,0,0,1,0,1",
                                "mesh x.json --box 0,0,0,1,1,nan",
                                "mesh x.json --at-box close",
                                "mesh x.json --max-memory much",
                                "mesh x.json --max-memory -1G",
                                "mesh x.json --times",
                                "mesh x.json --threads 0",
                                "eval x.json",
                                "eval x.json --points",
                                "eval x.json --points p.csv -o v.csv --json"}) {
    SCOPED_TRACE(arguments);
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err, "");
  }
}

TEST(Program, ListsEveryFamilyAsTextAndAsJson) {
  const std::array<std::array<const char*, 2>, 17> rows{{{"primaries", "elliptic_paraboloid"},
                                                         {"continuities", "G2"},
                                                         {"keeps", "auto"},
                                                         {"correspondences", "minimal_twist"},
                                                         {"modes", "anchor"},
                                                         {"frames", "moving"},
                                                         {"units", "mm"},
                                                         {"schemas", "AP242"},
                                                         {"trimlines", "edge_chain"},
                                                         {"magnitudes", "minimum_bending"},
                                                         {"shapes", "tension"},
                                                         {"exporters", "vtp"},
                                                         {"checks", "gap"},
                                                         {"families", "tension1"},
                                                         {"nodes", "soft_object"},
                                                         {"meshes", ".ply"},
                                                         {"columns", "mean_curvature"}}};
  for (const auto& [family, member] : rows) {
    SCOPED_TRACE(family);
    const Outcome text = run_program(std::string("list ") + family);
    EXPECT_EQ(text.code, 0);
    EXPECT_THAT(text.out, HasSubstr(member));
    const Outcome json = run_program(std::string("list --json ") + family);
    const JsonValue parsed = parse_json(json.out);
    ASSERT_TRUE(parsed.items());
    EXPECT_FALSE(parsed.items()->empty());
    EXPECT_THAT(json.out, HasSubstr(member));
  }
}

std::vector<std::string> names_of(const JsonValue& rows, const char* key) {
  std::vector<std::string> names;
  for (const JsonValue& row : *rows.items()) names.push_back(*row.find(key)->text());
  return names;
}

TEST(Program, ListsTheFamiliesWhenNoneIsNamed) {
  const Outcome text = run_program("list");
  EXPECT_EQ(text.code, 0);
  const std::vector<std::string> families = names_of(parse_json(run_program("list --json").out), "name");
  EXPECT_EQ(families.size(), 18u);
  for (const std::string& family : families) {
    EXPECT_THAT(text.out, HasSubstr("  " + family + " "));
    EXPECT_EQ(run_program("list " + family).code, 0);
  }
}

TEST(Program, UsesTheWordsOfListInTheSchemaAndInErrorMessages) {
  const JsonValue schema = parse_json(run_program("schema job").out);
  struct Where {
    const char *family, *definition, *before, *after;  ///< a job with a wrong word of the family
  };
  const Where places[] = {
      {"continuities", "continuity", R"("blends": {"b": {"from": {"continuity": )", "}}}"},
      {"magnitudes", "magnitude_rule", R"("blends": {"b": {"from": {"magnitude": {"rule": )", "}}}}"},
      {"keeps", "keep", R"("blends": {"b": {"from": {"keep": )", "}}}"},
      {"correspondences", "correspondence_rule", R"("blends": {"b": {"correspondence": {"rule": )", "}}}"},
      {"modes", "mode", R"("blends": {"b": {"shape": {"mode": )", "}}}"},
      {"frames", "frame", R"("blends": {"b": {"shape": {"frame": )", "}}}"},
      {"families", "family", R"("blends": {"b": {"shape": {"family": )", "}}}"},
      {"units", "unit", R"("unit": )", ""},
      {"exporters", "format", R"("output": {"formats": [)", "]}"},
      {"schemas", "step_schema", R"("output": {"step_schema": )", "}"}};
  const Folder folder;
  for (const Where& w : places) {
    SCOPED_TRACE(w.family);
    const auto listed = names_of(parse_json(run_program(std::string("list --json ") + w.family).out), "name");
    const JsonValue* definition = schema.find("$defs")->find(w.definition);
    ASSERT_NE(definition, nullptr);
    EXPECT_EQ(names_of(*definition->find("oneOf"), "const"), listed);
    write(folder / "job.json", std::string("{") + w.before + "\"?\"" + w.after + "}");
    std::string words = "is \"?\", must be ";
    for (std::size_t i = 0; i < listed.size(); ++i)
      words += (i == 0 ? "\"" : i + 1 == listed.size() ? " or \"" : ", \"") + listed[i] + "\"";
    EXPECT_THAT(run_program("verify " + quoted_path(folder / "job.json")).err, HasSubstr(words));
  }
}

TEST(Program, SaysWhatAnOptionMustBe) {
  EXPECT_THAT(run_program("verify x.json --tol-angle-deg -1").err,
              AllOf(HasSubstr("--tol-angle-deg: is -1, must be > 0\n"), Not(HasSubstr("e+308"))));
  EXPECT_THAT(run_program("verify x.json --tol-position inf").err, HasSubstr("is inf, must be > 0"));
  EXPECT_THAT(run_program("verify x.json --tol-position 1e-3x").err, HasSubstr("must be a number"));
  EXPECT_THAT(run_program("blend x.json -o ''").err, HasSubstr("--out: is empty, must be a folder"));
}

TEST(Program, ReportsStageTimesOnlyWhenAsked) {
  const Folder folder;
  const std::string job = example("coaxial-cylinders");
  EXPECT_NE(parse_json(run_program("verify --json --times " + job).out).find("times"), nullptr);
  EXPECT_EQ(parse_json(run_program("verify --json " + job).out).find("times"), nullptr);
  const std::string blend = "blend --format obj --force " + job + " -o " + quoted_path(folder.path());
  for (const char* flag : {"", " --times"}) {
    EXPECT_EQ(run_program(blend + flag).code, 0);
    const JsonValue report = parse_json(content(folder / "coaxial-cylinders.report.json"));
    EXPECT_EQ(report.find("times") != nullptr, *flag != 0);
    ASSERT_EQ(report.find("files")->items()->size(), 1u);  // the report does not list itself
    EXPECT_GT(*report.find("files")->items()->front().find("bytes")->number(), 1000.0);
  }
}

TEST(Program, WarnsOfAPrimaryThatNoBlendUses) {
  const Folder folder;
  std::string text = content(source() / "examples/specs/coaxial-cylinders.json");
  const std::string before = "\"primaries\": {";
  ASSERT_NE(text.find(before), std::string::npos);
  text.insert(text.find(before) + before.size(), R"( "spare": { "kind": "sphere", "radius": 1 },)");
  write(folder / "job.json", text);
  const Outcome outcome = run_program("verify " + quoted_path(folder / "job.json"));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("warning: /primaries/spare: is used by no blend"));
  EXPECT_THAT(run_program("verify " + example("coaxial-cylinders")).err, IsEmpty());
}

TEST(Program, PrintsEverySchema) {
  for (const char* of : {"job", "scene", "report"}) {
    const Outcome outcome = run_program(std::string("schema ") + of);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(parse_json(outcome.out).find("$defs"), nullptr);
  }
}

TEST(Program, BuildsVerifiesAndSaysWhatItWrote) {
  const Folder folder;
  const std::string out = quoted_path(folder / "out");
  const Outcome outcome =
      run_program("blend " + example("coaxial-cylinders") + " --format step,obj -o " + out);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("coaxial-cylinders.json: 1 blend, 2 seams, all within tolerance\n"),
                    HasSubstr("reducer"), HasSubstr("read back"), HasSubstr("(AP242, "),
                    HasSubstr(" coaxial-cylinders.obj, coaxial-cylinders.report.json")));
  EXPECT_THAT(folder.files(),
              testing::UnorderedElementsAre("out/coaxial-cylinders.step", "out/coaxial-cylinders.obj",
                                            "out/coaxial-cylinders.report.json"));
  EXPECT_THAT(outcome.out + outcome.err, Not(HasSubstr("\x1b")));  // no terminal, no colours
}

TEST(Program, TableFitsATerminal) {
  for (const char* name : {"coaxial-cylinders", "branch-to-main", "open-blend"}) {
    const Outcome outcome = run_program(std::string("verify ") + example(name));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_LE(widest(outcome.out), 80u) << outcome.out;
  }
}

TEST(Program, KeepsFilesThatExistUnlessForced) {
  const Folder folder;
  fs::create_directory(folder / "out");
  write(folder / "out/coaxial-cylinders.step", "mine");
  const std::string arguments =
      "blend " + example("coaxial-cylinders") + " --format step -o " + quoted_path(folder / "out");
  const Outcome refused = run_program(arguments);
  EXPECT_EQ(refused.code, 5);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("already exists"), HasSubstr("--force")));
  EXPECT_EQ(content(folder / "out/coaxial-cylinders.step"), "mine");
  EXPECT_EQ(folder.files().size(), 1u);
  EXPECT_EQ(run_program(arguments + " --force").code, 0);
  EXPECT_THAT(content(folder / "out/coaxial-cylinders.step"), HasSubstr("ISO-10303-21"));
}

TEST(Program, ReadsAJobFromStandardInput) {
  const Outcome outcome = run_program("verify - < " + example("coaxial-cylinders"), "exec");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("<stdin>: 1 blend"));
}

TEST(Program, ExitsWith1WhenBuiltButNotVerified) {
  const Outcome outcome = run_program("verify " + example("fig4-eq11-printed"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("1 not within tolerance"), HasSubstr("angle 6.3")));
}

TEST(Program, JudgesByTheTolerancesOnTheCommandLine) {
  const std::string verify = "verify " + example("coaxial-cylinders");
  EXPECT_EQ(run_program(verify + " --tol-position 1e-3").code, 0);
  const Outcome wide = run_program("verify " + example("fig4-eq11-printed") + " --tol-angle-deg 10 --json");
  EXPECT_NEAR(*parse_json(wide.out).find("tolerance")->find("angle_deg")->number(), 10.0, 1e-12);
  EXPECT_THAT(wide.out, HasSubstr("\"verified\": true"));
  EXPECT_EQ(wide.code, 0);
}

TEST(Program, PrintsTheReportAsJson) {
  const Outcome outcome = run_program("verify --json " + example("coaxial-cylinders"));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(*parse_json(outcome.out).find("verified")->boolean());
}

TEST(Program, IsQuietWhenAsked) {
  const Outcome outcome = run_program("verify --quiet " + example("fig4-eq11-printed"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST(Program, WritesTheSameBytesAgainAndOnOneThread) {
  const Folder folder;
  const auto run = [&](const std::string& name, const std::string& flags) {
    EXPECT_EQ(run_program("blend " + example("coaxial-cylinders") + " --format step,vtp,stl,obj --quiet " +
                              flags + " -o " + quoted_path(folder / name),
                          fixed_date)
                  .code,
              0);
  };
  run("first", "");
  run("again", "");
  run("one", "--threads 1");
  std::size_t compared = 0;
  for (const std::string& file : folder.files("first")) {
    const std::string name = file.substr(std::string("first/").size());
    for (const char* other : {"again/", "one/"})
      EXPECT_TRUE(content(folder / file) == content(folder / (other + name))) << other << name;
    ++compared;
  }
  EXPECT_GE(compared, 7u);
  EXPECT_EQ(folder.files().size(), 3 * compared);
}

// --- inspect
// ------------------------------------------------------------------------------------------------------

TEST(Inspect, GivesSelectorsThatChooseTheFaceTheyStandBy) {
  const fs::path part = source() / "examples/specs/parts/two-bodies.step";
  const Outcome table = run_program("inspect " + quoted_path(part));
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_THAT(table.out, AllOf(HasSubstr("two-bodies.step: 11 faces, "), HasSubstr("2 solids"),
                               HasSubstr("\"surface\": \"cylinder\""), HasSubstr("\"kind\": \"edge\"")));
  const JsonValue json = parse_json(run_program("inspect --json " + quoted_path(part)).out);
  ASSERT_EQ(json.find("faces")->items()->size(), 11u);
  // Pasted into a job, every selector finds one face: the job then fails at its trimline, never at the
  // selector.
  const Folder folder;
  for (const JsonValue& face : *json.find("faces")->items()) {
    write(folder / "job.json", R"({ "primaries": { "f": { "kind": "step_face", "file": ")" + part.string() +
                                   R"(", "select": )" + json_text(*face.find("select")) +
                                   R"( } }, "blends": { "x": { "v": [0, 1],
        "from": { "C": [0, "v", 0], "T": [1, 0, 0] }, "to": { "C": [1, "v", 0], "T": [1, 0, 0] } } } })");
    const Outcome used = run_program("verify " + quoted_path(folder / "job.json"));
    EXPECT_THAT(used.err, Not(HasSubstr("/select"))) << used.err;
    EXPECT_LE(used.code, 1) << used.err;
  }
}

TEST(Inspect, RefusesWhatIsNoPart) {
  const Folder folder;
  write(folder / "text.step", "hello");
  for (const std::string& name : std::vector<std::string>{"text.step", "missing.step"}) {
    const Outcome outcome = run_program("inspect " + quoted_path(folder / name));
    EXPECT_EQ(outcome.code, 5);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr(name + ": "));
  }
}

// --- what the file system and the user can do to it
// ----------------------------------------------------------------

TEST(Program, RefusesAHundredMegabytesOfBracketsAtOnce) {
  const Folder folder;
  write(folder / "brackets.json", std::string(100u << 20, '['));
  const auto start = std::chrono::steady_clock::now();
  for (const std::string& arguments : std::vector<std::string>{
           "blend " + quoted_path(folder / "brackets.json") + " -o " + quoted_path(folder / "out"),
           "blend - -o " + quoted_path(folder / "out") + " < " + quoted_path(folder / "brackets.json")}) {
    const Outcome outcome = run_program(arguments, "exec");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr(": 1 problem\n  is larger than 64 MB, the limit\n"));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_EQ(folder.files().size(), 1u);
}

TEST(Program, SaysWhyAJobCannotBeRead) {
  const Folder folder;
  for (const fs::path& job : {folder / "missing.json", folder.path()}) {
    const Outcome outcome = run_program("blend " + quoted_path(job) + " -o " + quoted_path(folder / "out"));
    EXPECT_EQ(outcome.code, 5);
    EXPECT_EQ(outcome.err.rfind(job.string() + ": ", 0), 0u) << outcome.err;
    EXPECT_EQ(outcome.err.find(job.filename().string()), outcome.err.rfind(job.filename().string()));
    EXPECT_THAT(folder.files(), IsEmpty());
  }
}

TEST(Program, SaysWhyAFolderCannotBeWritten) {
  const Folder folder;
  write(folder / "file", "mine");
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", fs::perms::owner_read | fs::perms::owner_exec);
  std::vector<std::string> places{"file", "file/below"};
  if (::geteuid() != 0) places.insert(places.end(), {"closed", "closed/below"});  // root may write anywhere
  for (const std::string& place : places) {
    SCOPED_TRACE(place);
    const Outcome outcome = run_program("blend " + example("coaxial-cylinders") + " --format step -o " +
                                        quoted_path(folder / place));
    EXPECT_EQ(outcome.code, 5);
    EXPECT_THAT(outcome.err, HasSubstr((folder / place).string()));
    EXPECT_THAT(folder.files(), testing::ElementsAre("file"));
    EXPECT_EQ(content(folder / "file"), "mine");
  }
}

TEST(Program, LeavesOnlyWholeFilesWhenTheDiskIsFull) {
  // A limit on the size of files acts like a full disk: writes beyond it fail. Blocks of 512 bytes.
  const Folder folder;
  const std::string formats = " --format step,vtp,stl,obj --quiet -o ";
  ASSERT_EQ(run_program("blend " + example("coaxial-cylinders") + formats + quoted_path(folder / "whole"),
                        fixed_date)
                .code,
            0);
  for (const char* blocks : {"1", "16", "48", "100", "400"}) {
    SCOPED_TRACE(blocks);
    const std::string out = std::string("out") + blocks;
    const Outcome outcome =
        run_program("blend " + example("coaxial-cylinders") + formats + quoted_path(folder / out),
                    "export " + fixed_date + "; trap '' XFSZ; ulimit -f " + blocks + "; exec");
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("coaxial-cylinders.json: "));
    for (const std::string& file : folder.files(out)) {
      const fs::path whole = folder / ("whole" + file.substr(out.size()));
      ASSERT_TRUE(fs::exists(whole)) << file;
      EXPECT_TRUE(content(folder / file) == content(whole)) << file;
    }
  }
}

TEST(Program, SaysThatStandardOutputIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const Outcome outcome = run_program("schema job > /dev/full", "exec");
  EXPECT_EQ(outcome.code, 5);
  EXPECT_THAT(outcome.err, HasSubstr("standard output cannot be written"));
}

/// What the program writes to standard error when that is a terminal.
std::string on_a_terminal(const std::string& arguments, const std::string& before) {
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (master < 0 || ::grantpt(master) != 0 || ::unlockpt(master) != 0) return "no terminal";
  const std::string terminal = ::ptsname(master);
  const std::string line =
      before + " '" BLENDWRIGHT_PROGRAM "' " + arguments + " >/dev/null 2>'" + terminal + "'";
  const int keep_open = ::open(terminal.c_str(), O_RDWR | O_NOCTTY);
  const int status = std::system(line.c_str());
  std::array<char, 4096> text{};
  const ssize_t size = status < 0 ? 0 : ::read(master, text.data(), text.size());
  ::close(keep_open);
  ::close(master);
  return std::string(text.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
}

TEST(Program, ColoursMessagesOnATerminalUnlessNoColorIsSet) {
  const std::string coloured = on_a_terminal("verify /missing.json", "env -u NO_COLOR");
  if (coloured == "no terminal") GTEST_SKIP() << "no pseudo-terminals here";
  EXPECT_THAT(coloured, AllOf(HasSubstr("missing.json"), HasSubstr("\x1b[31m")));
  const std::string plain = on_a_terminal("verify /missing.json", "NO_COLOR=1");
  EXPECT_THAT(plain, AllOf(HasSubstr("missing.json"), Not(HasSubstr("\x1b"))));
}

Running blending(const fs::path& folder) {
  return Running({"blend", "-", "-o", (folder / "out").string()},
                 content(source() / "examples/specs/coaxial-cylinders.json"), folder / "err");
}

TEST(Program, StopsAtCtrlCAndLeavesNothing) {
  const Folder folder;
  Running running = blending(folder.path());
  ASSERT_TRUE(running.handles(SIGINT));
  running.send(SIGINT);
  EXPECT_EQ(running.finish(), 4);
  EXPECT_THAT(content(folder / "err"), HasSubstr("<stdin>: stopped while "));
  EXPECT_THAT(folder.files(), testing::ElementsAre("err"));
}

TEST(Program, RunsToTheEndWhenNobodyStopsIt) {  // the negative control of the test above
  const Folder folder;
  Running running = blending(folder.path());
  ASSERT_TRUE(running.handles(SIGINT));
  EXPECT_EQ(running.finish(), 0) << content(folder / "err");
  EXPECT_THAT(folder.files(), Contains("out/job.step"));
}

}  // namespace
}  // namespace blendwright::test
