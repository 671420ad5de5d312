// Job files become the structs they describe, and every problem is found at once.
#include "app/json/job_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <numbers>

#include "app/json/job_keys.hpp"
#include "app/json/json_value.hpp"
#include "tests/app/program.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

constexpr double pi = std::numbers::pi;

JobSpec job(const std::string& text) { return read_job(text, "parts/joint.json"); }

std::vector<Problem> problems(const std::string& text) {
  try {
    static_cast<void>(job(text));
  } catch (const InputError& e) {
    return e.problems();
  }
  return {};
}

/// A job with one blend from cylinder "a" to "b"; `from` replaces its trimline, `more` goes into the blend.
std::string cylinders(const std::string& trimline = R"({ "kind": "isoline", "length": 0 })",
                      const std::string& side = "", const std::string& more = "") {
  return R"({ "primaries": { "a": { "kind": "cylinder", "radius": 1, "length": [-2, 0] },
                             "b": { "kind": "cylinder", "radius": 2, "length": [3, 5] } },
              "blends": { "x": { "from": { "primary": "a", "trimline": )" +
         trimline + side + R"( }, "to": { "primary": "b", "trimline": { "kind": "isoline", "length": 3 } })" +
         more + " } } }";
}

const PrimarySpec& primary(const JobSpec& spec, std::size_t i = 0) {
  return std::get<PrimarySpec>(spec.primaries.at(i).spec);
}
const TrimlineSpec& trimline(const JobSpec& spec) { return *spec.blends.at(0).sides[0].trimline; }

std::string primaries(const std::string& text) {
  return R"({ "primaries": { "p": )" + text + R"( }, "blends": { "x": {
    "from": { "C": [0, "v", 0], "T": [1, 0, 0] }, "to": { "C": [1, "v", 0], "T": [1, 0, 0] }, "v": [0, 1] } } })";
}

TEST(JobReader, ReadsTheShortestJobWithItsDefaults) {
  const JobSpec spec = job(cylinders());
  EXPECT_EQ(spec.name, "joint");
  EXPECT_EQ(spec.folder, "parts");
  EXPECT_EQ(spec.source_hash.size(), 16u);
  EXPECT_EQ(spec.unit, LengthUnit::millimetre);
  ASSERT_EQ(spec.primaries.size(), 2u);
  EXPECT_EQ(spec.primaries[1].name, "b");
  EXPECT_EQ(primary(spec).numbers.at("radius"), 1.0);
  EXPECT_EQ(primary(spec).u, (Interval{-2, 0}));
  EXPECT_FALSE(primary(spec).v);
  const BlendEntry& blend = spec.blends.at(0);
  EXPECT_EQ(blend.sides[0].primary, "a");
  EXPECT_EQ(blend.sides[0].side.continuity, Continuity::G1);
  EXPECT_EQ(blend.sides[0].side.rule, MagnitudeRule::circle_like);
  EXPECT_EQ(blend.shape.mode, BlendMode::chord);
  EXPECT_EQ(blend.correspondence.rule, CorrespondenceRule::arc_length);
  EXPECT_FALSE(blend.literal());
  EXPECT_EQ(spec.tolerance.position, 1e-6);
  EXPECT_THAT(spec.output.formats, ElementsAre(OutputFormat::step, OutputFormat::vtp, OutputFormat::png));
}

TEST(JobReader, ReadsCommentsAndAByteOrderMark) {
  EXPECT_EQ(job("\xEF\xBB\xBF// a comment with { [ and \"\n" + cylinders() + "/* { */").blends.size(), 1u);
}

TEST(JobReader, TakesConstantFormulasWhereverItTakesNumbers) {
  const JobSpec spec = job(R"({ "let": { "r": 2, "d": "2*r", "e": 0.5 },
    "primaries": { "p": { "kind": "cylinder", "radius": "d/r", "length": ["-r", "e"],
                          "axis": { "origin": ["d", 0, 0], "direction": ["e", 0, 0] } } },
    "blends": { "x": { "from": { "C": ["r", "v", 0], "T": [1, 0, 0] }, "to": { "C": ["d", "v", 0], "T": [1, 0, 0] },
                       "v": [0, "pi/r"], "shape": { "c": "-d" } } },
    "tolerance": { "position": "1/1000" } })");
  EXPECT_EQ(spec.constants.at("d"), 4.0);
  EXPECT_EQ(primary(spec).numbers.at("radius"), 2.0);
  EXPECT_EQ(primary(spec).u, (Interval{-2, 0.5}));
  EXPECT_EQ(primary(spec).placement.t, Vec3(4, 0, 0));
  EXPECT_DOUBLE_EQ(spec.blends[0].v->v.hi, pi / 2);
  EXPECT_EQ(spec.blends[0].shape.ode[2], (SweepOde{1, -4, 0}));
  EXPECT_DOUBLE_EQ(spec.tolerance.position, 1e-3);
}

TEST(JobReader, ConvertsDegreesByTheSuffixOfTheKey) {
  const JobSpec turned = job(cylinders(R"({ "kind": "isoline", "angle_deg": 90, "range": [-2, -1] })",
                                       R"(, "tangent_angle_deg": 30)"));
  EXPECT_EQ(trimline(turned).direction, IsoDirection::constant_v);
  EXPECT_DOUBLE_EQ(trimline(turned).value, pi / 2);
  EXPECT_EQ(*trimline(turned).range, (Interval{-2, -1}));
  EXPECT_DOUBLE_EQ(turned.blends[0].sides[0].side.tangent_angle.value, pi / 6);
  const JobSpec half = job(cylinders(R"({ "kind": "isoline", "length": -1, "range_deg": [0, 180] })"));
  EXPECT_EQ(trimline(half).direction, IsoDirection::constant_u);
  EXPECT_DOUBLE_EQ(trimline(half).range->hi, pi);
  const JobSpec band = job(primaries(R"({ "kind": "sphere", "radius": 1, "latitude_deg": [-45, 90] })"));
  EXPECT_DOUBLE_EQ(primary(band).u->lo, -pi / 4);
}

TEST(JobReader, SeesWhetherACurveCloses) {
  const auto closed = [](const std::string& curve) {
    return trimline(job(cylinders("{ " + curve + " }"))).curve.closed;
  };
  const std::string space = R"~("kind": "projected", "curve": )~";
  EXPECT_TRUE(closed(space + R"~(["cos(v)", "sin(v)", -1])~"));
  EXPECT_FALSE(closed(space + R"~(["cos(v)", "sin(v)", -1], "v": [0, "pi"])~"));
  const std::string cornered = space + R"~(["cos(v)", "v*sin(v)", -1])~";  // the ends meet, at a corner
  EXPECT_FALSE(closed(cornered));
  EXPECT_TRUE(closed(cornered + R"~(, "closed": true)~"));
  const std::string parameters = R"~("kind": "parameters", "curve": )~";
  EXPECT_TRUE(closed(parameters + R"~(["-1 + 0.1*sin(v)", "v"])~"));     // once around the cylinder
  EXPECT_FALSE(closed(parameters + R"~(["-1 + 0.1*sin(v)", "v/2"])~"));  // half around
  EXPECT_FALSE(closed(parameters + R"~(["v/10", "0"])~"));
  const std::string through = R"~("kind": "projected", "points": [[1,0,-1], [0,1,-1], [-1,0,-1], [0,-1,-1])~";
  EXPECT_FALSE(closed(through + "]"));
  EXPECT_TRUE(closed(through + ", [1,0,-1]]"));
  EXPECT_EQ(trimline(job(cylinders("{ " + through + ", [1,0,-1]] }"))).curve.points.size(), 4u);
}

TEST(JobReader, ReadsEveryShapeControl) {
  const auto shape = [](const std::string& text, const std::string& side = "") {
    return job(cylinders(R"({ "kind": "isoline", "length": 0 })", side, ", \"shape\": " + text))
        .blends[0]
        .shape;
  };
  EXPECT_EQ(shape(R"({ "tension": 3 })").ode[1], SweepOde::tension(3));
  EXPECT_EQ(shape(R"({ "tension": 3 })", R"(, "continuity": "G2")").tension, 3.0);
  EXPECT_EQ(shape(R"({ "q": 0 })").repeated_root, 0.0);
  const BlendShape each = shape(R"({ "b": 2, "c": [-1, -2, -3], "d": [0, 1, 2], "frame": "moving" })");
  EXPECT_EQ(each.ode[0], (SweepOde{2, -1, 0}));
  EXPECT_EQ(each.ode[2], (SweepOde{2, -3, 2}));
  EXPECT_EQ(each.frame, BlendFrame::moving);
  const BlendShape pulled = shape(R"({ "mode": "anchor", "anchor": [1, 2, 3] })");
  EXPECT_EQ(pulled.mode, BlendMode::anchor);
  EXPECT_EQ(pulled.anchor, Vec3(1, 2, 3));
  const BlendShape fixed = shape(R"({ "c": -1, "frame": { "fixed": [[0, 1, 0], [0, 0, 1], [1, 0, 0]] } })");
  EXPECT_EQ(fixed.frame, BlendFrame::fixed);
  EXPECT_EQ(fixed.axes.col(0), Vec3(0, 1, 0));  // the first vector typed is the first axis
  EXPECT_EQ(shape(R"({ "family": "triple" })", R"(, "continuity": "G2")").family, SixthOrderFamily::triple);
}

TEST(JobReader, ReadsMagnitudesAsNumbersAndLaws) {
  const auto side = [](const std::string& text) {
    return job(cylinders(R"({ "kind": "isoline", "length": 0 })", ", \"magnitude\": " + text))
        .blends[0]
        .sides[0]
        .side;
  };
  EXPECT_EQ(side(R"({ "rule": "constant", "factor": 2 })").rule, MagnitudeRule::constant);
  EXPECT_EQ(side(R"({ "factor": 2 })").factor.at(0).value, 2.0);
  const SideSpec law = side(R"~({ "rule": "chord", "factor": [[0, 1], [0.5, "sqrt(2)"]] })~");
  ASSERT_EQ(law.factor.size(), 2u);
  EXPECT_EQ(law.factor[1].t, 0.5);
  EXPECT_DOUBLE_EQ(law.factor[1].value, std::sqrt(2.0));
}

TEST(JobReader, ReadsPrimariesThatAreMoreThanNumbers) {
  const JobSpec net = job(primaries(R"({ "kind": "bspline", "degree": [1, 2],
      "points": [[[0,0,0], [0,1,0], [0,2,0]], [[1,0,0], [1,1,1], [1,2,0]]] })"));
  EXPECT_EQ(primary(net).points.size(), 6u);
  EXPECT_EQ(primary(net).point_rows, 2);
  EXPECT_EQ(primary(net).points[4], Vec3(1, 1, 1));
  EXPECT_EQ(primary(net).degree, (std::array{1, 2}));
  const JobSpec vase =
      job(primaries(R"({ "kind": "revolution", "profile": ["1 + u^2", "u"], "u": [0, 2] })"));
  EXPECT_THAT(primary(vase).formulas, ElementsAre("1 + u^2", "u"));
  const JobSpec wall = job(primaries(R"({ "kind": "extrusion", "profile": ["v", "v^2", 0], "length": [0, 1],
      "direction": [0, 0, 2] })"));
  EXPECT_EQ(primary(wall).direction, Vec3(0, 0, 2));
  EXPECT_EQ(primary(wall).formulas[2], "0");
  const JobSpec tube = job(primaries(R"~({ "kind": "formula", "S": ["cos(v)", "sin(v)", "u"], "u": [0, 1],
      "v": [0, "2*pi"], "closed": [false, true] })~"));
  EXPECT_EQ(primary(tube).closed, (std::array{false, true}));
  const JobSpec face = job(primaries(R"~({ "kind": "step_face", "file": "part.step",
      "select": { "surface": "plane", "near": [1, 2, 3] } })~"));
  const auto& spec = std::get<StepFaceSpec>(face.primaries[0].spec);
  EXPECT_EQ(spec.file, "part.step");
  EXPECT_EQ(spec.select.surface, "plane");
  EXPECT_EQ(*spec.select.near, Vec3(1, 2, 3));
}

TEST(JobReader, ReadsLiteralBoundaryData) {
  const auto blend = [](const std::string& more, const std::string& d = "") {
    const std::string from = R"~("from": { "C": ["cos(v)", "sin(v)", 0], "T": [0, 0, 1])~" + d + " }, ";
    const std::string to = R"~("to": { "C": ["2*cos(v)", "2*sin(v)", 3], "T": [0, 0, 1] }, )~";
    return job(R"~({ "blends": { "x": { )~" + from + to + more + " } } }").blends[0];
  };
  EXPECT_TRUE(blend(R"~("v": [0, "2*pi"])~").v->closed);
  EXPECT_FALSE(blend(R"~("v": [0, "pi"])~").v->closed);
  EXPECT_FALSE(blend(R"~("v": [0, "2*pi"], "closed": false)~").v->closed);
  EXPECT_EQ(blend(R"~("v": [0, 1])~").sides[0].side.continuity, Continuity::G1);
  EXPECT_EQ(blend(R"~("v": [0, 1])~", R"~(, "D": [0, 0, 0])~").sides[0].side.continuity, Continuity::G2);
}

TEST(JobReader, ReportsEveryProblemInTheOrderOfTheFile) {
  const auto found = problems(R"({
    "tolerance": { "position": -1 },
    "blends": { "x": { "to": { "primary": "b", "trimlin": 1 }, "from": 3 } },
    "primaries": { "b": { "kind": "cylinder", "length": [1, 0], "radius": "x" } } })");
  std::vector<std::string> places;
  for (const Problem& p : found) places.push_back(p.where);
  EXPECT_THAT(places, ElementsAre("/tolerance/position", "/blends/x/to/trimline", "/blends/x/to/trimlin",
                                  "/blends/x/from", "/primaries/b/length", "/primaries/b/radius"));
}

TEST(JobReader, NamesLineAndColumnOfASyntaxError) {
  const auto found = problems("{\n  \"blends\": {,}\n}");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].message, HasSubstr("line 2, column 14"));
}

TEST(JobReader, PointsAtTheCommaThatIsOneTooMany) {
  const auto message = [](const std::string& text) {
    const auto found = problems(text);
    return found.size() == 1 ? found[0].message : std::to_string(found.size()) + " problems";
  };
  const std::string words = ": a comma before '}' or ']' is one too many";
  EXPECT_EQ(message("{ \"a\": [1,\n 2 , ] }"), "line 2, column 4" + words);
  EXPECT_EQ(message("{ \"a,\": 1, // a comment, with commas,\n /* , */ }"), "line 1, column 10" + words);
  // Other mistakes keep their own words: a comma in a comment or a text is none.
  for (const char* other : {"{ \"a\": [1 /*,*/ }", "{ \"a\", }", "{ \"a\": ]", "{ \"a\": [1, 2 }"})
    EXPECT_THAT(message(other), testing::AllOf(HasSubstr("line 1, "), testing::Not(HasSubstr("too many"))))
        << other;
}

TEST(JobReader, PrintsNamesInUtf8AndWhatIsNoneAsQuestionMarks) {
  EXPECT_EQ(in_quotes("gr\xC3\xB6\xC3\x9F"
                      "e \xE2\x82\xAC \xF0\x9F\x94\xA7"),
            "\"gr\xC3\xB6\xC3\x9F"
            "e \xE2\x82\xAC \xF0\x9F\x94\xA7\"");
  EXPECT_EQ(in_quotes("a\x1b[31m\x7f\n"), "\"a?[31m??\"");
  EXPECT_EQ(in_quotes("\xC2\x9B"
                      "1m"),
            "\"?1m\"");  // a terminal's escape as one character
  // Overlong, half, surrogate, beyond the last code point.
  for (const char* bad : {"\xC0\xAF", "\xC3", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xFF"})
    EXPECT_EQ(in_quotes(bad), '"' + std::string(std::string_view(bad).size(), '?') + '"');
  EXPECT_EQ(in_quotes("\xC3\xB6\xC3\xB6\xC3\xB6", 2), "\"\xC3\xB6\xC3\xB6...\"");  // never half a character
  EXPECT_EQ(pointer_part("\xC3\xB6/~"), "\xC3\xB6~1~0");
}

TEST(JobReader, GivesUpOnAHundredProblemsWithACount) {
  std::string text = "{ \"blends\": 1";
  for (int i = 0; i < 150; ++i) text += ", \"zzz" + std::to_string(i) + "\": 1";
  const auto found = problems(text + "}");
  ASSERT_EQ(found.size(), 101u);
  EXPECT_EQ(found.back().message, "51 more problems");
}

TEST(JobReader, RefusesHugeTextBeforeReadingIt) {
  const auto start = std::chrono::steady_clock::now();
  const std::string brackets(100u << 20, '[');
  EXPECT_THAT(problems(brackets), ElementsAre(Field(&Problem::message, HasSubstr("larger than 64 MB"))));
  EXPECT_THAT(problems(std::string(1u << 20, '[')),
              ElementsAre(Field(&Problem::message, HasSubstr("nested deeper than 64 levels"))));
  EXPECT_THAT(problems("[" + std::string(4u << 20, ' ') + "1]"),
              ElementsAre(Field(&Problem::message, HasSubstr("must be an object"))));
  std::string many = "[0";
  for (int i = 0; i < 5'000'001; ++i) many += ",0";
  EXPECT_THAT(problems(many + "]"),
              ElementsAre(Field(&Problem::message, HasSubstr("more than 5000000 values"))));
  // Generous: the point is that nothing grows with the size beyond one pass.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

// --- every key of the tables is really read
// ---------------------------------------------------------------------

JsonValue& descend(JsonValue& value, const std::vector<std::string>& path) {
  JsonValue* at = &value;
  for (const std::string& key : path) {
    auto& members = std::get<JsonValue::Object>(at->value);
    const auto known =
        std::find_if(members.begin(), members.end(), [&](const JsonMember& m) { return m.key == key; });
    at = known == members.end() ? &at->add(key, JsonValue(JsonValue::Object())) : &known->value;
  }
  return *at;
}

void set(JsonValue& object, const std::string& key, JsonValue value) {
  auto& members = std::get<JsonValue::Object>(object.value);
  std::erase_if(members, [&](const JsonMember& m) { return m.key == key; });
  members.push_back({key, std::move(value)});
}

/// Where an object of the tables stands in a job.
std::vector<std::string> path_of(const std::string& object) {
  const std::map<std::string, std::vector<std::string>> places = {
      {"job", {}},
      {"blend", {"blends", "x"}},
      {"side", {"blends", "x", "from"}},
      {"magnitude", {"blends", "x", "from", "magnitude"}},
      {"shape", {"blends", "x", "shape"}},
      {"frame_axes", {"blends", "x", "shape", "frame"}},
      {"correspondence", {"blends", "x", "correspondence"}},
      {"fit", {"blends", "x", "fit"}},
      {"fit_unknowns", {"blends", "x", "fit", "unknowns"}},
      {"fit_bounds", {"blends", "x", "fit", "bounds"}},
      {"tolerance", {"tolerance"}},
      {"output", {"output"}},
      {"axis", {"primaries", "a", "axis"}},
      {"face_selector", {"primaries", "a", "select"}}};
  if (object.rfind("primary ", 0) == 0) return {"primaries", "a"};
  if (object.rfind("objective ", 0) == 0) return {"blends", "x", "fit", "objectives"};
  if (object.rfind("trimline ", 0) == 0) return {"blends", "x", "from", "trimline"};
  return places.at(object);
}

TEST(JobReader, ReadsEveryKeyOfItsTables) {
  std::size_t keys = 0;
  for (const ObjectInfo& object : job_objects())
    for (const KeyInfo& key : object.keys) {
      SCOPED_TRACE(object.name + ": " + key.name);
      const bool literal = object.name == "blend" && (key.name == "v" || key.name == "closed");
      JsonValue root =
          parse_json(literal ? primaries(R"({ "kind": "plane", "x": [0, 1], "y": [0, 1] })") : cylinders());
      if (object.name == "face_selector")
        set(descend(root, {"primaries"}), "a", JsonValue::object({{"kind", "step_face"}, {"file", "x"}}));
      const std::vector<std::string> path = path_of(object.name);
      JsonValue& target = descend(root, path);
      const std::size_t blank = object.name.find(' ');
      if (blank != std::string::npos) target = JsonValue::object({{"kind", object.name.substr(blank + 1)}});
      set(target, key.name, JsonValue());  // null is never a good value, so that reading it is noticed
      std::string where;
      for (const std::string& part : path) where += "/" + part;
      if (object.name.rfind("objective ", 0) == 0) {
        target = JsonValue::array({target});
        where += "/0";
      }
      where += "/" + key.name;
      EXPECT_THAT(problems(json_text(root)), Contains(Field(&Problem::where, where)));
      ++keys;
    }
  EXPECT_GE(keys, 100u);
}

// --- whatever comes, the answer is a job or an InputError
// ---------------------------------------------------------

std::vector<std::string> example_texts() {
  std::vector<std::string> texts;
  for (const auto& entry : fs::directory_iterator(fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/specs"))
    if (entry.path().extension() == ".json") texts.push_back(content(entry.path()));
  std::sort(texts.begin(), texts.end());  // the order of a folder is not fixed
  return texts;
}

std::string mutated(std::string text, Rng& rng) {
  static const std::string alphabet = "{}[]\",:0123456789.-+eE/*\\ \nabcuvxyz\xC3\xFF\x01";
  const int changes = integer(rng, 1, 6);
  for (int i = 0; i < changes && !text.empty(); ++i) {
    const auto at = static_cast<std::size_t>(integer(rng, 0, static_cast<int>(text.size()) - 1));
    const auto length = static_cast<std::size_t>(integer(rng, 1, 12));
    switch (integer(rng, 0, 3)) {
      case 0:
        text[at] = alphabet[static_cast<std::size_t>(integer(rng, 0, static_cast<int>(alphabet.size()) - 1))];
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at,
                    text.substr(static_cast<std::size_t>(integer(rng, 0, static_cast<int>(text.size()) - 1)),
                                length));
        break;
      default:
        text.insert(
            at, 1,
            alphabet[static_cast<std::size_t>(integer(rng, 0, static_cast<int>(alphabet.size()) - 1))]);
    }
  }
  return text;
}

TEST(JobReader, AnswersMutatedJobsWithAJobOrAnInputError) {
  const std::vector<std::string> texts = example_texts();
  ASSERT_GE(texts.size(), 10u);
  std::size_t refused = 0, read = 0;
  Rng rng(20240521);
  for (int i = 0; i < bounded(3000); ++i) {
    const std::string text =
        mutated(texts[static_cast<std::size_t>(integer(rng, 0, static_cast<int>(texts.size()) - 1))], rng);
    try {
      static_cast<void>(job(text));
      ++read;
    } catch (const InputError& e) {
      ASSERT_FALSE(e.problems().empty());
      for (const Problem& p : e.problems()) ASSERT_FALSE(p.message.empty());
      ++refused;
    } catch (const std::exception& e) {
      FAIL() << "mutation " << i << ": " << e.what() << "\n" << text;
    }
  }
  EXPECT_GT(refused, 100u);  // the mutations bite,
  EXPECT_GT(read, 100u);     // and not all of them are syntax errors
}

}  // namespace
}  // namespace blendwright::test
