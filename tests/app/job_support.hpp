#pragma once
// Example jobs for tests: read, changed, run, written to a fresh folder.
#include <unistd.h>

#include <filesystem>
#include <string>

#include "app/json/job_reader.hpp"
#include "app/pipeline/write_outputs.hpp"

namespace blendwright::test {

inline std::filesystem::path specs_folder() {
  return std::filesystem::path(BLENDWRIGHT_SOURCE_DIR) / "examples/specs";
}

inline JobSpec example_job(const std::string& name) {
  return read_job_file(specs_folder() / (name + ".json"));
}

/// The same joint taken from the primaries instead of typed boundary data, asking `continuity` on both sides. The
/// figures give both trimlines on one v, which is kept.
inline JobSpec from_primaries(JobSpec job, Continuity continuity) {
  for (BlendEntry& blend : job.blends) {
    for (BlendSideEntry& side : blend.sides) {
      side.literal.reset();
      side.side.continuity = continuity;
      if (side.trimline)
        side.trimline->curve.closed = side.trimline->curve.closed || (blend.v && blend.v->closed);
    }
    if (blend.v) blend.correspondence.rule = CorrespondenceRule::as_given;
    blend.v.reset();
    blend.shape = {};
  }
  return job;
}

/// A folder of its own, removed at the end.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("blendwright-" + name + "-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace blendwright::test
