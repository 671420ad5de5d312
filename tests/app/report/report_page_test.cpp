// Pages of real results.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <sstream>

#include "app/json/scene_reader.hpp"
#include "app/report/blend_page.hpp"
#include "app/report/mesh_page.hpp"
#include "app/report/report_file.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/text_file.hpp"
#include "tests/app/job_support.hpp"
#include "tests/app/report/xml_reading.hpp"

namespace blendwright::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::vector<std::vector<std::string>> table_below(vtkXMLDataElement* root, const std::string& caption) {
  std::vector<std::vector<std::string>> rows;
  for (vtkXMLDataElement* table : elements(root, "table")) {
    const auto captions = elements(table, "caption");
    if (captions.empty() || text_of(captions[0]) != caption) continue;
    for (vtkXMLDataElement* tr : elements(table, "tr")) {
      rows.emplace_back();
      for (int i = 0; i < tr->GetNumberOfNestedElements(); ++i)
        rows.back().push_back(text_of(tr->GetNestedElement(i)));
    }
  }
  return rows;
}

TEST(BlendPage, TellsTheFiguresOfTheResult) {
  const JobResult result = run_job(example_job("coaxial-cylinders"));
  const std::string page = html(blend_page(result, nullptr, "", "blendwright verify job.json"));
  const auto root = read_xml(page);
  ASSERT_NE(root, nullptr);
  EXPECT_THAT(page, HasSubstr("\xE2\x9C\x93 verified"));
  const auto rows = table_below(root, "Worst figures along each trimline");
  ASSERT_EQ(rows.size(), 3u);
  for (std::size_t side = 0; side < 2; ++side) {
    const SeamReport& seam = result.blends[0].stages.back().seams[side];
    EXPECT_EQ(rows[1 + side][0], "reducer");
    EXPECT_EQ(rows[1 + side][1], side == 0 ? "from thin" : "to wide");
    EXPECT_EQ(rows[1 + side][3], "G2");
    EXPECT_THAT(rows[1 + side][4], HasSubstr(scientific_text(seam.gap.worst, 3)));
    EXPECT_THAT(rows[1 + side][5], HasSubstr(scientific_text(Radians(seam.angle.worst).degrees(), 3)));
  }
  EXPECT_EQ(elements(root, "svg").size(), 3u);
  EXPECT_THAT(page, HasSubstr(result.job.source_hash));
  EXPECT_THAT(page, HasSubstr("blendwright verify job.json"));
  const auto shape = table_below(root, "reducer: shape parameters");
  EXPECT_THAT(shape.at(0), ::testing::ElementsAre("what", "value", "meaning"));
  // Every row says what it means.
  for (const auto& row : shape) EXPECT_FALSE(row.at(2).empty()) << row[0];
}

TEST(BlendPage, OfABadJointSaysWhatFailed) {
  JobResult result = run_job(example_job("coaxial-cylinders"));
  result.job.tolerance.position = 1e-16;
  const std::string page = html(blend_page(result, nullptr, "", ""));
  EXPECT_THAT(page, HasSubstr("not verified"));
  EXPECT_THAT(page, HasSubstr("Failed: reducer/from: gap"));
}

TEST(BlendPage, EscapesNames) {
  JobSpec job = example_job("coaxial-cylinders");
  job.blends[0].name = "<script>alert(1)</script>";
  const std::string page = html(blend_page(run_job(job), nullptr, "", "a <b> & 'c'"));
  const auto root = read_xml(page);
  ASSERT_NE(root, nullptr);
  EXPECT_TRUE(elements(root, "script").empty());
  EXPECT_EQ(table_below(root, "Worst figures along each trimline").at(1).at(0), "<script>alert(1)</script>");
}

TEST(MeshPage, TellsTheFiguresOfTheMesh) {
  const SceneFile scene = build_scene_file(fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/scenes/s0-12ab.json");
  MeshJob job;
  job.cells = 40;
  const MeshResult result = run_mesh_job(scene, job);
  const auto root = read_xml(html(mesh_page(scene, result, "", "")));
  ASSERT_NE(root, nullptr);
  const auto rows = table_below(root, "Figures; lengths in mm");
  const auto row = [&](const std::string& name) {
    for (const auto& r : rows)
      if (r.at(0) == name) return r.at(1);
    return std::string("missing");
  };
  EXPECT_EQ(row("triangles"), std::to_string(result.made.facts.triangles));
  EXPECT_EQ(row("area"), number_text(result.made.facts.area, 6));
  EXPECT_EQ(row("source hash"), scene.source_hash);
}

TEST(ReportFile, HasItsPictureInside) {
  const TemporaryFolder folder("report");
  const fs::path file = folder.path() / "report.html";
  const JobResult result = run_job(example_job("coaxial-cylinders"));
  std::vector<std::string> notes;
  require_report_place(file, false);
  write_blend_report(file, result, nullptr, "", notes);
  const std::string page = read_text_file(file, 64 << 20);
  const auto root = read_xml(page);
  ASSERT_NE(root, nullptr);
  const auto images = elements(root, "img");
  if (!notes.empty()) {
    EXPECT_THAT(notes[0], HasSubstr("no picture"));
    EXPECT_TRUE(images.empty());
    GTEST_SKIP() << notes[0];
  }
  ASSERT_EQ(images.size(), 1u);
  // A PNG starts with these eight bytes.
  EXPECT_THAT(attribute(images[0], "src"), ::testing::StartsWith("data:image/png;base64,iVBORw0KGgo"));
  EXPECT_THAT(attribute(images[0], "alt"), HasSubstr("largest gap"));
  // Nothing else is left in the folder, and the same again is refused.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
  EXPECT_THROW(require_report_place(file, false), IoError);
  EXPECT_NO_THROW(require_report_place(file, true));
}

/// The first browser of these that is installed; empty: none.
std::string browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system((std::string("command -v ") + name + " >/dev/null 2>&1").c_str()) == 0) return name;
  return "";
}

/// What the browser says on its console about a page; nullopt when it cannot run here.
std::optional<std::string> console_of(const std::string& program, const fs::path& folder,
                                      const fs::path& page) {
  const std::string at = folder.string();
  const std::string command =
      "cd " + at + " && HOME=" + at + " timeout 60 " + program +
      " --headless --no-sandbox --disable-gpu --disable-background-networking"
      " --enable-logging=stderr --screenshot=page.png --window-size=1000,1400 file://" +
      page.string() + " >/dev/null 2>log.txt";
  fs::remove(folder / "page.png");
  if (std::system(command.c_str()) != 0 || !fs::exists(folder / "page.png")) return std::nullopt;
  std::istringstream log(read_text_file(folder / "log.txt", 64 << 20));
  std::string words;
  for (std::string line; std::getline(log, line);)
    if (line.find("CONSOLE") != std::string::npos) words += line + "\n";
  return words;
}

// The page forbids every request by its own policy, and a browser reports whatever is tried.
TEST(ReportFile, OpensInABrowserWithoutAWordOrARequest) {
  const std::string program = browser();
  if (program.empty()) GTEST_SKIP() << "no Chromium is installed";
  const TemporaryFolder folder("browser");
  const fs::path file = folder.path() / "report.html";
  std::vector<std::string> notes;
  write_blend_report(file, run_job(example_job("coaxial-cylinders")), nullptr, "", notes);
  const std::optional<std::string> said = console_of(program, folder.path(), file);
  if (!said) GTEST_SKIP() << program << " cannot run here";
  EXPECT_EQ(*said, "");
  // The same with one picture from outside is reported.
  std::string page = read_text_file(file, 64 << 20);
  page.insert(page.find("<h1>"), "<img src=\"http://example.org/x.png\" alt=\"\" />");
  write_text_file(file, page);
  EXPECT_THAT(console_of(program, folder.path(), file).value_or(""), HasSubstr("example.org"));
}

TEST(ReportFile, RefusesPlacesThatCannotBe) {
  const TemporaryFolder folder("report-place");
  EXPECT_THROW(require_report_place(folder.path() / "report.pdf", false), InputError);
  EXPECT_THROW(require_report_place(folder.path() / "missing" / "report.html", false), IoError);
  fs::create_directory(folder.path() / "is.html");
  EXPECT_THROW(require_report_place(folder.path() / "is.html", true), IoError);
}

}  // namespace
}  // namespace blendwright::test
