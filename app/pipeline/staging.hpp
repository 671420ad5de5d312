#pragma once
// How the files of a run appear together: everything is made in a hidden folder beside its final place and
// moved there when all of it is whole.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "kernel/base/error.hpp"

namespace blendwright {

struct WrittenFile {
  std::filesystem::path path;
  std::string kind;  ///< "step", "vtp", "png", "stl", "obj", "ply", "csv", "report"
  std::size_t bytes = 0;
};

/// Throws IoError naming the first file that exists already.
void refuse_existing(const std::vector<std::filesystem::path>& files);

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
  /// An error that names a file of the hidden folder names its final place instead.
  [[nodiscard]] IoError with_final_names(const IoError& error) const;
  /// Throws IoError when what stands at the place of one of the files is no regular file.
  static void require_places(const std::vector<std::filesystem::path>& files);
  void publish(const std::vector<std::filesystem::path>& files);

 private:
  std::filesystem::path folder_, path_;
  bool made_ = false, published_ = false;
};

/// The same for files in any folders.
class StagedFiles {
 public:
  /// Throws IoError; InputError when two files are the same.
  explicit StagedFiles(const std::vector<std::filesystem::path>& files);
  [[nodiscard]] std::filesystem::path of(const std::filesystem::path& file) const;
  [[nodiscard]] IoError with_final_names(IoError error) const;
  /// Moves those of the files that were written, and says how large they are.
  [[nodiscard]] std::vector<WrittenFile> publish();

 private:
  std::vector<std::filesystem::path> files_;
  std::map<std::filesystem::path, StagingFolder> folders_;
};

}  // namespace blendwright
