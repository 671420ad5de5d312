#pragma once
// Two results of any kind -> how far they are from each other.
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/pipeline/staging.hpp"
#include "kernel/base/units.hpp"
#include "verify/surface/body_deviation.hpp"

namespace blendwright {

/// One of the two, as it is compared.
struct ComparedResult {
  std::string name;                   ///< as it was asked for, without folders
  std::vector<std::string> pieces{};  ///< names of the surfaces or meshes that take part
  bool surfaces = false;              ///< false: triangles only
  double sag = 0.0;  ///< beside trimmed borders of surfaces, distances are right to four times this
  std::size_t triangles = 0;
};

struct CompareResult {
  std::array<ComparedResult, 2> results;
  LengthUnit unit = LengthUnit::millimetre;
  std::array<BodyDeviation, 2> ways;  ///< from the first to the second, and back
  std::vector<std::string> notes{};
  std::vector<WrittenFile> files{};
  std::optional<double> limit{};

  /// The Hausdorff distance: the larger of both ways, NaN when one is.
  [[nodiscard]] double largest() const;
  /// No point of either is further from the other; empty: not proven.
  [[nodiscard]] std::optional<double> proven() const;
  /// Whether `limit` holds; empty: the largest distance found is below it, and what is proven is not.
  [[nodiscard]] std::optional<bool> within() const;
};

struct CompareJob {
  /// Jobs, scenes, STEP files, meshes, or folders that `blend` wrote; "#name" behind one means that blend,
  /// face, part or node alone.
  std::array<std::string, 2> files;
  std::optional<double> limit{};
  std::filesystem::path output{};  ///< .vtp: the first with its distances as a column; empty: none
  bool overwrite = false;
};

/// Of a job its blends are compared, as they are exported; of a STEP file its faces. Pieces of which both
/// have one of the same name are compared with each other and the rest is left out; without such names
/// everything is compared with everything. The second is converted to the unit of the first where both have
/// one. `subject`: set to the file that is being read, for messages. Throws InputError, IoError, and what
/// building a job or meshing a scene throws.
[[nodiscard]] CompareResult run_compare(const CompareJob& job, std::string& subject,
                                        const Progress& progress = {});

}  // namespace blendwright
