#include "app/cli/arguments.hpp"
#include "app/cli/options.hpp"
#include "app/pipeline/picture_views.hpp"
#include "app/pipeline/show.hpp"

namespace blendwright {
namespace {

std::string views_help() {
  std::string text = "views side by side, separated by commas:";
  for (const NamedView& v : named_views()) text.append(" ").append(v.name).append(",");
  text.pop_back();
  return text;
}

std::string show_footer() {
  std::string text = "\nWhat --show may be:\n";
  for (const ShowRow& row : show_table())
    text.append("  ").append(row.name).append(12 - row.name.size(), ' ').append(row.description).append("\n");
  text +=
      "  trimlines   plots of gap, angle, curvature jump, magnitudes and correspondence\n"
      "Without it: the gap where there are blends, else the plain surface.\n"
      "\nExamples:\n"
      "  blendwright picture joint.json -o joint.png --show zebra --views iso,front,top\n"
      "  blendwright picture joint.json -o draft.png --show draft --pull 0,0,1\n"
      "  blendwright picture out -o gap.png --show gap --background dark\n"
      "  blendwright picture scene.json -o field.png --show field --plane z=0\n"
      "  blendwright picture part.step -o off.png --show deviation --to other.step\n";
  return text;
}

/// What is coloured and how.
void add_colours(CLI::App* sub, PictureCommand& command) {
  sub->add_option("--show", command.show, "what the colours mean; see below");
  std::vector<std::string> curvatures;
  for (const CurvatureRow& row : curvature_table()) curvatures.emplace_back(row.name);
  sub->add_option("--curvature", command.curvature, "which one --show curvature means")
      ->capture_default_str()
      ->check(CLI::IsMember(curvatures));
  sub->add_flag("--log", command.log, "logarithmic colours, of the magnitude");
  sub->add_option("--range", command.range, "LO,HI of the colour bar; default: over the values")
      ->check(readable(range_argument, "LO,HI"));
  sub->add_option("--pull", command.pull, "draft: direction x,y,z that a mould opens in; default 0,0,1")
      ->check(readable(direction_argument, "X,Y,Z"));
  sub->add_option("--light", command.light, "isophotes: direction x,y,z to the light; default: from the eye")
      ->check(readable(direction_argument, "X,Y,Z"));
  sub->add_option("--stripes", command.stripes, "zebra: pairs of stripes over half a turn")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 256.0));
  sub->add_option("--comb-lines", command.comb_lines, "comb: lines across each blend")
      ->capture_default_str()
      ->check(CLI::Range(2, 512));
  sub->add_option("--to", command.to, "deviation: the other input, of any kind");
  sub->add_option("--plane", command.plane,
                  "field: plane x=1, y=1 or z=1; default: through the middle, across the shortest side")
      ->check(readable(plane_argument, "AXIS=PLACE"));
}

}  // namespace

void add_picture(CLI::App& app, Program& program) {
  const auto command = std::make_shared<PictureCommand>();
  CLI::App* sub = verb(app, "picture");
  sub->add_option(
         "INPUT", command->input,
         "job, scene (.json; - reads standard input), .step, .vtp, .stl, .obj, .ply, or a folder that "
         "\"blend\" wrote")
      ->required();
  sub->add_option("-o,--output", command->output, "file to write, .png")->required();
  add_colours(sub, *command);
  CLI::Option* views = sub->add_option("--views", command->views, views_help());
  views->delimiter(',');
  sub->add_option("--from", command->from, "one view from the direction x,y,z instead")
      ->check(readable(direction_argument, "X,Y,Z"))
      ->excludes(views);
  sub->add_option("--size", command->size, "WIDTHxHEIGHT in pixels")
      ->capture_default_str()
      ->check(readable(size_argument, "WxH"));
  sub->add_option("--background", command->background, "white or dark")
      ->capture_default_str()
      ->check(CLI::IsMember({"white", "dark"}));
  sub->add_option("--solid", command->solid, "of a scene: node that is meant instead of its solid");
  sub->add_option("--cells", command->cells, "of a scene: cells along the longest side")
      ->capture_default_str()
      ->check(CLI::Range(1, 1 << 20));
  sub->add_option("--box", command->box,
                  "of a scene: box to show, x0,y0,z0,x1,y1,z1; default: around the solid")
      ->check(readable(box_argument, "BOX"));
  sub->add_flag("--force", command->force, "replace a file that exists");
  CLI::Option* json = sub->add_flag("--json", command->json, "print JSON: title, figure, view");
  sub->add_flag("--times", command->times, "time of each stage in the JSON")->needs(json);
  sub->add_flag("--quiet", command->quiet, "no title, no warnings, no progress");
  add_threads(sub, command->threads);
  sub->footer(show_footer());
  sub->callback([command, &program] { program.code = picture(*command, program.console); });
}

}  // namespace blendwright
