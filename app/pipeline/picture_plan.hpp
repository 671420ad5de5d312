#pragma once
// Private to the picture job: plans of single kinds of pictures.
#include "app/pipeline/picture_job.hpp"

namespace blendwright {

/// Largest figures along all trimlines of an input.
struct WorstFigures {
  bool known = false;
  double gap = 0.0, angle_deg = 0.0, jump = 0.0;
  /// "largest gap 1.0e-08 mm, angle 1.2e-05 deg, jump 0 1/mm".
  [[nodiscard]] std::string text(const PictureInput& input) const;
};
[[nodiscard]] WorstFigures worst_of(const PictureInput& input);

[[nodiscard]] PicturePlan plan_of_surface(PictureInput input, const PictureJob& job,
                                          const Progress& progress);
[[nodiscard]] PicturePlan plan_of_field(const PictureInput& input, const PictureJob& job,
                                        const Progress& progress);

/// Name, size, background and views of every picture.
void set_up(Picture& picture, const PictureInput& input, const PictureJob& job);
/// The scale of the bar: the range that was asked for, or one over the values; outliers (creases have any
/// curvature) do not stretch it, and the tick at its end says so.
[[nodiscard]] ColourScale scale_of(const PictureJob& job, std::vector<double> values);

}  // namespace blendwright
