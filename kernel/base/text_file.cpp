#include "kernel/base/text_file.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "kernel/base/error.hpp"

namespace blendwright {
namespace fs = std::filesystem;

std::string read_text_file(const fs::path& file, std::size_t limit) {
  std::error_code error;
  if (fs::is_directory(file, error)) throw IoError(file.string() + ": is a folder, must be a file");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw IoError(file.string() + ": cannot be read (" + std::strerror(errno) + ")");
  std::string text;
  for (std::array<char, 65536> block; in.read(block.data(), block.size()), in.gcount() > 0;) {
    text.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > limit)
      throw IoError(file.string() + ": is larger than " + std::to_string(limit >> 20) + " MB, the limit");
  }
  if (in.bad()) throw IoError(file.string() + ": cannot be read (" + std::strerror(errno) + ")");
  return text;
}

UnfinishedFile::UnfinishedFile(fs::path file) : file_(std::move(file)) {
  std::error_code ignored;
  if (fs::exists(file_, ignored) && !fs::is_regular_file(file_, ignored))
    throw IoError(file_.string() + ": is not a regular file; choose another name");
  // The extension stays last: some writers choose the format by it.
  std::string name = ".";
  name += file_.stem().string() + ".unfinished-" + std::to_string(::getpid()) + file_.extension().string();
  path_ = file_.parent_path() / name;
}

UnfinishedFile::~UnfinishedFile() {
  std::error_code ignored;
  if (!published_) fs::remove(path_, ignored);
}

void UnfinishedFile::publish() {
  std::error_code error;
  fs::rename(path_, file_, error);
  if (error) throw IoError(file_.string() + ": cannot be written (" + error.message() + ")");
  published_ = true;
}

void write_text_file(const fs::path& file, std::string_view text) {
  UnfinishedFile unfinished(file);
  std::ofstream out(unfinished.path(), std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) throw IoError(file.string() + ": cannot be written (" + std::strerror(errno) + ")");
  unfinished.publish();
}

}  // namespace blendwright
