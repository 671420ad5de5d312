#pragma once
// Whole text files in and out; writing goes through a temporary file and a rename.
#include <filesystem>
#include <string>
#include <string_view>

namespace blendwright {

/// Throws IoError: path and the system's reason. `limit`: larger files are refused (bytes).
[[nodiscard]] std::string read_text_file(const std::filesystem::path& file, std::size_t limit);
/// Throws IoError and leaves nothing under `file` (an older file stays).
void write_text_file(const std::filesystem::path& file, std::string_view text);

/// A name beside `file` for its unfinished content; `publish` renames it to `file`, the destructor removes it
/// otherwise.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(
      std::filesystem::path file);  ///< throws IoError when `file` is a folder or a device
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  void publish();  ///< throws IoError

 private:
  std::filesystem::path file_, path_;
  bool published_ = false;
};

}  // namespace blendwright
