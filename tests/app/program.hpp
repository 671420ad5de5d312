#pragma once
// Runs the program as a user does, and looks at what it leaves behind.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace blendwright::test {

namespace fs = std::filesystem;

/// A folder of its own, removed at the end.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "blendwright-test-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }
  [[nodiscard]] fs::path operator/(const std::string& name) const { return path_ / name; }
  /// Every file below, hidden and unfinished ones too, relative and sorted by the file system.
  [[nodiscard]] std::vector<std::string> files(const std::string& below = "") const {
    std::vector<std::string> found;
    if (!fs::exists(path_ / below)) return found;
    for (const auto& entry : fs::recursive_directory_iterator(path_ / below))
      if (!entry.is_directory()) found.push_back(fs::relative(entry.path(), path_).string());
    return found;
  }

 private:
  fs::path path_;
};

inline std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

struct Outcome {
  int code = -1;  ///< exit code; 128 + signal when it was killed
  std::string out, err;
};

/// `arguments` as typed in a shell; `before` goes in front of the program ("ulimit -f 8;").
inline Outcome run_program(const std::string& arguments, const std::string& before = "") {
  const Folder folder;
  const std::string out = (folder / "out").string(), err = (folder / "err").string();
  const std::string line = before + " '" BLENDWRIGHT_PROGRAM "' " + arguments;
  const int status = std::system(("( " + line + " ) >'" + out + "' 2>'" + err + "' </dev/null").c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, content(out), content(err)};
}

inline std::string quoted_path(const fs::path& path) {
  std::string text(1, '\'');
  text += path.string();
  return text += '\'';
}

}  // namespace blendwright::test
