#include "app/report/mesh_page.hpp"

#include "app/report/blend_page.hpp"
#include "app/report/json_tables.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {

ReportPage mesh_page(const SceneFile& scene, const MeshResult& result, const std::string& picture,
                     const std::string& command) {
  const JsonValue report = parse_json(mesh_report_json(scene, result, false));
  const MeshFacts& facts = result.made.facts;
  const std::string unit = name(scene.spec.unit);
  ReportPage page{.title = "Mesh report: " + scene.name,
                  .verdict = ReportPage::Verdict::none,
                  .summary = std::to_string(facts.triangles) + " triangles in " +
                             std::to_string(facts.components) +
                             (facts.components == 1 ? " component" : " components") + "; vertices at most " +
                             scientific_text(facts.largest_distance) + " " + unit + " from the surface.",
                  .sections = {}};
  PageSection shape{.title = "The solid"};
  if (!picture.empty())
    shape.figures.push_back({.png = picture,
                             .svg = {},
                             .caption = "The mesh of \"" + scene.spec.solid + "\".",
                             .alternative = "Shaded picture of the solid " + scene.spec.solid});
  shape.tables.push_back(detail::member_table("Figures; lengths in " + unit, report));
  page.sections.push_back(std::move(shape));

  PageSection notes{.title = "Findings"};
  for (const Problem& w : scene.scene.warnings)
    notes.paragraphs.push_back("Warning: " + w.where + ": " + w.message);
  if (facts.cut_by_box) notes.paragraphs.push_back("Note: the box cuts the solid.");
  for (const std::string& n : result.notes) notes.paragraphs.push_back("Note: " + n);
  if (notes.paragraphs.empty()) notes.paragraphs.push_back("There is nothing to note.");
  page.sections.push_back(std::move(notes));

  PageSection nodes{.title = "Nodes"};
  PageTable table{"", {{"node", "kind"}}};
  for (const NodeSpec& n : scene.spec.nodes) table.rows.push_back({n.name, n.kind});
  nodes.tables.push_back(std::move(table));
  page.sections.push_back(std::move(nodes));

  if (!result.files.empty()) {
    PageSection files{.title = "Files"};
    PageTable list{"", {{"file", "format", "bytes"}}};
    for (const WrittenFile& f : result.files)
      list.rows.push_back({f.path.filename().string(), f.kind, std::to_string(f.bytes)});
    files.tables.push_back(std::move(list));
    page.sections.push_back(std::move(files));
  }
  page.sections.push_back(reproduction(detail::cell_text(detail::member(report, "program")), scene.name,
                                       scene.source_hash, command));
  return page;
}

}  // namespace blendwright
