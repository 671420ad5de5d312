#pragma once
// A picture of a job, a scene, a STEP file or a mesh: what it shows is planned without a display.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/pipeline/field_section.hpp"
#include "app/pipeline/picture_input.hpp"
#include "app/pipeline/show.hpp"
#include "app/pipeline/stage_time.hpp"
#include "app/pipeline/staging.hpp"
#include "kernel/exchange/picture.hpp"

namespace blendwright {

struct PictureJob {
  std::string input;  ///< as read_picture_input() takes it
  std::string to{};   ///< deviation: the other input, or
  std::shared_ptr<const PictureInput> other{};
  bool trimlines = false;  ///< plots along the trimlines instead of a view
  bool automatic = false;  ///< show the gap where there are blends, else the plain surface
  Show show = Show::plain;
  ShowOptions options{};
  PictureInputOptions reading{};
  std::vector<std::string> views{};     ///< names of named_views(); empty: the best one
  std::optional<Vec3> from{};           ///< direction from the object to the eye, instead of a named view
  std::optional<SectionPlane> plane{};  ///< field; default: through the middle, across the shortest side
  std::optional<Interval> range{};      ///< of the colour bar, instead of one over the values
  std::size_t comb_lines = 24;
  std::optional<Vec3> to_light{};  ///< isophotes
  std::filesystem::path output{};
  int width = 1280, height = 960;
  bool dark = false, overwrite = false;
};

/// What the picture is about, in numbers.
struct PictureFigure {
  std::string name, unit;  ///< "gap", "mm"
  double least = 0.0, most = 0.0;
};

/// A picture before it is drawn.
struct PicturePlan {
  std::optional<Picture> picture;  ///< or
  std::optional<PlotSheet> plots;
  std::optional<PictureFigure> figure;
  std::vector<std::string> notes;
  [[nodiscard]] const std::string& title() const { return picture ? picture->title : plots->title; }
};
/// Throws InputError ("--show": what the input cannot show, with what it can; "--views", "--plane",
/// "--range",
/// "--to"), and what read_picture_input() throws.
[[nodiscard]] PicturePlan plan_picture(const PictureJob& job, const Progress& progress = {});
/// The same for an input that was read; `job.input` is not looked at.
[[nodiscard]] PicturePlan plan_picture(PictureInput input, const PictureJob& job,
                                       const Progress& progress = {});

struct PictureResult {
  PicturePlan plan;
  std::vector<WrittenFile> files;
  std::vector<StageTime> times;
};
/// Plans, draws and writes. Throws InputError ("--output": no .png, "--size") and IoError (no display; the
/// file exists) too.
[[nodiscard]] PictureResult run_picture_job(const PictureJob& job, const Progress& progress = {});
/// As JSON text; clock readings only when `times`.
[[nodiscard]] std::string picture_report_json(const PictureResult& result, bool times);

}  // namespace blendwright
