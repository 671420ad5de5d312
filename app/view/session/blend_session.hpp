#pragma once
// A job being shaped by hand: what the viewer drags, without a window. Every change goes through apply(), so
// that undo, redo, saving and tests see the same history.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/pipeline/run_job.hpp"

namespace blendwright {

/// A number or a choice of one blend, as a slider shows it.
struct SessionControl {
  std::string name;   ///< "fillet: tension", "fillet: magnitude from"
  std::string label;  ///< short, for the slider: "tension"
  std::size_t blend = 0;
  enum class Kind { number, choice } kind = Kind::number;
  double value = 0.0, low = 0.0, high = 1.0;  ///< choice: index
  bool logarithmic = false;
  std::vector<std::string> choices{};
};

/// A point on a trimline to take hold of.
struct SessionHandle {
  enum class Kind {
    trimline,  ///< moves the trimline along its primary
    magnitude  ///< sits at C + T / 3; changes the magnitude here and smoothly around
  } kind = Kind::trimline;
  std::size_t blend = 0, side = 0, index = 0;  ///< index along the line
  double v = 0.0;  ///< trimline: parameter of the line as the job gives it; magnitude: of the blend
  Vec3 position;
  enum class Reach { whole, here } reach = Reach::whole;  ///< trimline: all of it follows, or the part here
};

/// The surface as it is drawn: a grid of points with exact normals and error columns, filled anew by every
/// reshape into the same memory.
struct SessionGrid {
  std::size_t nu = 0, nv = 0;                         ///< point i * nv + j at u_i, v_j
  std::vector<float> positions;                       ///< 3 per point, relative to `origin`
  std::vector<float> normals;                         ///< 3 per point, exact
  std::vector<float> gap, angle_deg, curvature_jump;  ///< of the trimlines, blended linearly across
  Vec3 origin = Vec3::Zero();
};

/// What picking shows.
struct PickedPoint {
  std::string object;  ///< "fillet", "main pipe"
  Vec3 point;
  std::optional<UV> uv{};
  Vec3 normal = Vec3::Zero();
  std::optional<double> mean_curvature{}, gaussian_curvature{}, least_radius{};
  std::optional<double> gap{}, angle_deg{}, curvature_jump{};
};

class BlendSession {
 public:
  /// `text`: the job file's own text. Builds every blend. Throws as read_job and run_job do.
  BlendSession(const std::string& text, JobSpec job, std::size_t nu = 200, std::size_t nv = 200);
  ~BlendSession();
  BlendSession(BlendSession&&) noexcept;
  BlendSession& operator=(BlendSession&&) noexcept;

  [[nodiscard]] std::vector<SessionControl> controls() const;
  [[nodiscard]] std::vector<SessionHandle> handles() const;
  [[nodiscard]] std::size_t blends() const;
  [[nodiscard]] const JobSpec& job() const;
  [[nodiscard]] const SessionGrid& grid(std::size_t blend) const;
  [[nodiscard]] const Blend& blend(std::size_t blend) const;
  [[nodiscard]] const std::vector<std::pair<std::string, Surface>>& primaries() const;

  /// Sets control `index` of controls(); values are clamped to its range. A value that cannot be built
  /// (resonance, trimlines that cross) leaves everything as it was and says why. The list of a blend does not
  /// change while it is shaped: tension (named q where the job has the root q; its low end stands for none),
  /// mode and, unless the boundary data are typed, the magnitude factor and the continuity of both sides.
  /// What a choice takes away with it (G2: q, b, c, d and frames, which only the fourth order has) is in the
  /// message.
  struct Outcome {
    bool done = true;
    std::string message{};  ///< for the status line; empty: nothing to say
  };
  Outcome set(std::size_t control, double value);
  /// Moves a handle to the place of its primary nearest to `target`, a point in space. Reach whole: an
  /// isoline gets another value, other trimlines are shifted by the same (du, dv) everywhere. Reach here: the
  /// trimline's shift has a point per handle, this one moves and those nearby follow in part; a shift of two
  /// points or more that the job has already gives the handles their places. An end on the border of the
  /// primary stays on it. A magnitude handle runs along T: a constant factor becomes a law with a point per
  /// handle, of a law the nearest point is scaled.
  Outcome drag(const SessionHandle& handle, const Vec3& target);
  /// Ends one gesture: everything since the last commit() is one step of undo. undo() and redo() end it too.
  void commit();
  bool undo();
  bool redo();
  [[nodiscard]] bool changed() const;  ///< since the last save, or since opening

  /// Worst gap, angle and curvature jump of blend k to its primaries: verify's measurement at the grid's
  /// places along v. NaN where there is no measurement.
  struct Errors {
    double gap = 0.0, angle_deg = 0.0, curvature_jump = 0.0;
  };
  [[nodiscard]] Errors errors(std::size_t blend) const;
  [[nodiscard]] PickedPoint picked(std::size_t blend, UV at) const;

  /// The job's text with the changes (comments and layout kept).
  [[nodiscard]] std::string saved_text() const;
  void mark_saved();  ///< once the text is where it shall be
  /// The result as `blend` would make it, for STEP and the other formats.
  [[nodiscard]] JobResult result(const Progress& progress = {}) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace blendwright
