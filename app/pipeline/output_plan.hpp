#pragma once
// Which files a job writes, and how they appear together: everything is made in a hidden folder beside its
// final place and moved there when all of it is whole.
#include <filesystem>
#include <vector>

#include "app/pipeline/run_job.hpp"
#include "kernel/brep/shape.hpp"

namespace blendwright {

[[nodiscard]] bool wants(const JobResult& result, OutputFormat format);

/// Names of everything that will be written; an empty path is not wanted.
struct OutputPlan {
  std::filesystem::path step, picture, plots, stl, obj, report;
  std::vector<std::filesystem::path> blend_meshes, primary_meshes, trimlines;
  [[nodiscard]] std::vector<std::filesystem::path> all() const;
};
[[nodiscard]] OutputPlan plan_outputs(const JobResult& result, const Assembly& assembly,
                                      const std::filesystem::path& folder);

/// Throws IoError naming the first file that exists already.
void refuse_existing(const OutputPlan& plan);

/// A hidden folder inside `folder` (made when missing); publish() moves files out of it, the destructor
/// removes it, and `folder` too when it was made here and nothing was published. Throws IoError.
class StagingFolder {
 public:
  explicit StagingFolder(const std::filesystem::path& folder);
  ~StagingFolder();
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;
  /// Where to write the file whose final place is `file`.
  [[nodiscard]] std::filesystem::path of(const std::filesystem::path& file) const {
    return path_ / file.filename();
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  void publish(const std::vector<std::filesystem::path>& files);

 private:
  std::filesystem::path folder_, path_;
  bool made_ = false, published_ = false;
};

}  // namespace blendwright
