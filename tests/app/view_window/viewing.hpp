#pragma once
// Runs the viewer with a script of events on a display of its own, and reads what it tells and draws.
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "app/json/json_value.hpp"
#include "kernel/base/units.hpp"
#include "tests/app/program.hpp"

namespace blendwright::test {

struct Viewed {
  int code = -1;
  std::vector<JsonValue> states;
  std::string err;
};

/// `arguments`: files and flags as typed in a shell.
inline Viewed viewed(const std::string& arguments, const std::string& events) {
  const Folder folder;
  write(folder / "events.txt", events);
  const Outcome o =
      run_program("view " + arguments + " --script " + quoted_path(folder / "events.txt"), "unset DISPLAY;");
  Viewed v{o.code, {}, o.err};
  std::istringstream lines(o.out);
  for (std::string line; std::getline(lines, line);) v.states.push_back(parse_json(line));
  return v;
}

struct Pixels {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  ///< rows from the bottom

  [[nodiscard]] const unsigned char* at(int x, int y) const {
    return &rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x))];
  }
  [[nodiscard]] int difference(int x, int y, int x2, int y2) const {
    int most = 0;
    for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(at(x, y)[c] - at(x2, y2)[c]));
    return most;
  }
  [[nodiscard]] bool is_background(int x, int y) const {
    return std::all_of(at(x, y), at(x, y) + 3, [](unsigned char c) { return c > 250; });
  }
  /// Of what is not background, right of `left` and above `bottom`.
  [[nodiscard]] std::pair<Vec2, Vec2> extent_of_object(int left, int bottom) const {
    Vec2 lo(1e9, 1e9), hi = -lo;
    for (int y = bottom; y < height; ++y)
      for (int x = left; x < width; ++x)
        if (!is_background(x, y)) {
          lo = lo.cwiseMin(Vec2(x, y));
          hi = hi.cwiseMax(Vec2(x, y));
        }
    return {lo, hi};
  }
};

inline Pixels read_png(const fs::path& file) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  const int* size = reader->GetOutput()->GetDimensions();
  Pixels p{size[0], size[1], {}};
  const auto* data = static_cast<const unsigned char*>(reader->GetOutput()->GetScalarPointer());
  p.rgb.assign(data, data + 3 * static_cast<std::ptrdiff_t>(size[0]) * size[1]);
  return p;
}

}  // namespace blendwright::test
