#include "app/pipeline/staging.hpp"

#include <unistd.h>

#include <algorithm>

#include "kernel/exchange/mesh_files.hpp"

namespace blendwright {

namespace fs = std::filesystem;

namespace {

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path().lexically_normal() : fs::path(".");
}

}  // namespace

void refuse_existing(const std::vector<fs::path>& files) {
  for (const fs::path& file : files)
    if (fs::exists(file))
      throw IoError(file.string() + ": already exists; use --force to replace it, or write to another place");
}

StagingFolder::StagingFolder(const fs::path& folder)
    : folder_(folder), path_(folder / (".unfinished-" + std::to_string(::getpid()))) {
  std::error_code error;
  made_ = !fs::exists(folder_, error);
  fs::create_directories(folder_, error);
  if (error || !fs::is_directory(folder_))
    throw IoError(folder_.string() + ": cannot be made a folder (" +
                  (error ? error.message() : "it is a file") + "); choose another output folder");
  fs::create_directories(path_, error);
  if (error)
    throw IoError(folder_.string() + ": cannot be written to (" + error.message() +
                  "); choose another output folder");
}

StagingFolder::~StagingFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (made_ && !published_) fs::remove(folder_, ignored);  // only when empty
}

IoError StagingFolder::with_final_names(const IoError& error) const {
  std::string text = error.what();
  for (std::size_t at = 0; (at = text.find(path_.string(), at)) != std::string::npos;)
    text.replace(at, path_.string().size(), folder_.string());
  return IoError(text);
}

void StagingFolder::require_places(const std::vector<fs::path>& files) {
  for (const fs::path& file : files)
    if (fs::exists(file) && !fs::is_regular_file(file))
      throw IoError(file.string() + ": is not a regular file; choose another name");
}

void StagingFolder::publish(const std::vector<fs::path>& files) {
  require_places(files);
  for (const fs::path& file : files) {
    std::error_code error;
    fs::rename(of(file), file, error);
    if (error) throw IoError(file.string() + ": cannot be written (" + error.message() + ")");
    published_ = true;
  }
}

StagedFiles::StagedFiles(const std::vector<fs::path>& files) : files_(files) {
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (folder_of(files[i]) == folder_of(files[j]) && files[i].filename() == files[j].filename())
        throw InputError("--output", "names " + files[i].string() + " twice; must name each file once");
  StagingFolder::require_places(files);
  for (const fs::path& file : files) folders_.try_emplace(folder_of(file), folder_of(file));
}

fs::path StagedFiles::of(const fs::path& file) const { return folders_.at(folder_of(file)).of(file); }

IoError StagedFiles::with_final_names(IoError error) const {
  for (const auto& [path, folder] : folders_) error = folder.with_final_names(error);
  return error;
}

std::vector<WrittenFile> StagedFiles::publish() {
  std::vector<WrittenFile> written;
  for (const fs::path& file : files_)
    if (fs::exists(of(file)))
      written.push_back(
          {file, lower_case_extension(file).substr(1), static_cast<std::size_t>(fs::file_size(of(file)))});
  StagingFolder::require_places(files_);
  for (const WrittenFile& file : written) folders_.at(folder_of(file.path)).publish({file.path});
  return written;
}

}  // namespace blendwright
