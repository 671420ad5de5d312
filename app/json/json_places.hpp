#pragma once
// Where the values of a JSON document stand in its text, comments and all, and how to change some of them
// without touching the rest.
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/json/json_value.hpp"

namespace blendwright {

/// A value in the text: its bytes, and for objects and arrays the places of what they hold.
struct JsonPlace {
  std::size_t begin = 0, end = 0;  ///< first byte, one past the last
  std::string key{};               ///< member of an object: its name
  std::size_t key_begin = 0;       ///< member of an object: where the key's quote stands
  std::vector<JsonPlace> inside{};
  /// The member of this name, or the item of a list at this index ("0", "1", ...); null when there is none.
  [[nodiscard]] const JsonPlace* find(std::string_view name) const;
};

/// The place of the value that starts at or after `from`. `text` must be what parse_json accepts.
[[nodiscard]] JsonPlace json_place(std::string_view text, std::size_t from = 0);

/// Changes members of one object within a text. Whatever is not named stays byte by byte, comments included;
/// what is new is laid out like its surroundings: on the same line where that stays within 110 columns.
class JsonEdit {
 public:
  using Path = std::vector<std::string>;  ///< keys, and indices of lists, from the object down
  /// The number that a value of the text stands for, when it is a formula; else the value itself. Numbers
  /// that stand for the new one already are kept as they are typed.
  using Meaning = std::function<JsonValue(const JsonValue&)>;

  /// `object`: where the object starts in the text.
  JsonEdit(std::string text, std::size_t object, Meaning meaning);

  /// The member's value becomes `value`; members and objects on the way are added when they are missing.
  /// Lists of equal length are changed number by number.
  void set(const Path& path, const JsonValue& value);
  void remove(const Path& path);
  [[nodiscard]] bool has(const Path& path) const;
  [[nodiscard]] JsonValue value(const Path& path) const;  ///< null when there is none

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  [[nodiscard]] const JsonPlace* find(const Path& path) const;
  [[nodiscard]] JsonValue parsed(const JsonPlace& place) const;
  void add(const JsonPlace& object, const std::string& key, const JsonValue& value);
  bool set_inside(const JsonPlace& place, const JsonValue& old, const JsonValue& value);
  void splice(std::size_t begin, std::size_t end, std::string by);

  std::string text_;
  std::size_t object_;
  Meaning meaning_;
  JsonPlace root_;
};

}  // namespace blendwright
