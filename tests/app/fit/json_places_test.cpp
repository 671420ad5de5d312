// Members of an object change within its text; everything else stays byte by byte.
#include "app/json/json_places.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace blendwright::test {
namespace {

JsonEdit edit(const std::string& text) {
  return JsonEdit(text, 0,
                  [](const JsonValue& v) { return v.text() && *v.text() == "2*pi" ? JsonValue(6.25) : v; });
}

std::string with(const std::string& text, const JsonEdit::Path& path, const JsonValue& value) {
  JsonEdit e = edit(text);
  e.set(path, value);
  EXPECT_EQ(json_text(edit(e.text()).value(path)), json_text(value)) << e.text();
  return e.text();
}

std::string without(const std::string& text, const std::string& key) {
  JsonEdit e = edit(text);
  e.remove({key});
  EXPECT_FALSE(edit(e.text()).has({key})) << e.text();
  static_cast<void>(parse_json(e.text()));
  return e.text();
}

TEST(JsonEdit, ReplacesAValueAndNothingElse) {
  EXPECT_EQ(with("{ \"a\" : 1 , // one\n \"b\":[1,2] }", {"a"}, 2), "{ \"a\" : 2 , // one\n \"b\":[1,2] }");
  EXPECT_EQ(with("\xEF\xBB\xBF// { \"a\": 0 }\n{ \"a\" /* { */ : \"x}\\\"\" }", {"a"}, "y"),
            "\xEF\xBB\xBF// { \"a\": 0 }\n{ \"a\" /* { */ : \"y\" }");
  EXPECT_EQ(with("{ \"\\u0061\": { \"b\": null } }", {"a", "b"}, true), "{ \"\\u0061\": { \"b\": true } }");
}

TEST(JsonEdit, ChangesListsNumberByNumber) {
  EXPECT_EQ(with("{ \"a\": [ [0, 1.50], /* mid */ [0.5 , 2] ] }", {"a"},
                 JsonValue::array({JsonValue::array({0, 1.5}), JsonValue::array({0.5, 3})})),
            "{ \"a\": [ [0, 1.50], /* mid */ [0.5 , 3] ] }");
}

TEST(JsonEdit, KeepsWhatStandsForTheValueAlready) {
  const std::string text = "{ \"v\": [0, \"2*pi\"], \"n\": 1.0e1, \"f\": [\"x\", 5] }";
  JsonEdit e = edit(text);
  e.set({"v"}, JsonValue::array({0, 6.25}));
  e.set({"n"}, 10);
  e.set({"f"}, JsonValue::array({"x", "5"}));
  EXPECT_EQ(e.text(), text);
  e.set({"v"}, JsonValue::array({0, 6.5}));
  EXPECT_NE(e.text(), text);
}

TEST(JsonEdit, AddsWhereAPersonWould) {
  EXPECT_EQ(with("{}", {"a"}, 1), "{ \"a\": 1 }");
  EXPECT_EQ(with("{ }", {"a", "b", "c"}, 1), "{ \"a\": { \"b\": { \"c\": 1 } } }");
  EXPECT_EQ(with("{ \"a\": 1 }", {"b"}, 2), "{ \"a\": 1, \"b\": 2 }");
  EXPECT_EQ(with("{ \"a\": 1 /* one */ }", {"b"}, 2), "{ \"a\": 1, /* one */ \"b\": 2 }");
  EXPECT_EQ(with("{\n  \"a\": 1 // one\n}", {"b"}, 2), "{\n  \"a\": 1, // one\n  \"b\": 2\n}");
  EXPECT_EQ(with("{\r\n\t\"a\": 1 // one\r\n}", {"b"}, 2), "{\r\n\t\"a\": 1, // one\r\n\t\"b\": 2\r\n}");
  EXPECT_EQ(with("{ \"a\": 1,\n  \"b\": 2 }", {"c"}, 3), "{ \"a\": 1,\n  \"b\": 2,\n  \"c\": 3 }");
  EXPECT_EQ(with("{ \"a\": 1, // last comma\n }", {"a"}, 5), "{ \"a\": 5, // last comma\n }");
}

TEST(JsonEdit, BreaksLinesAtTheColumnLimit) {
  JsonValue::Array law;
  for (int i = 0; i < 6; ++i) law.push_back(JsonValue::array({i / 6.0, 1.0 + i / 7.0}));
  const std::string text = with("{ \"a\": { \"primary\": \"branch\" } }", {"a", "factor"}, law);
  EXPECT_EQ(
      text.find("{ \"a\": { \"primary\": \"branch\",\n         \"factor\": [[0, 1], [0.16666666666666666,"),
      0u)
      << text;
  for (std::size_t at = 0, end; at < text.size(); at = end + 1) {
    end = std::min(text.find('\n', at), text.size());
    EXPECT_LE(end - at, 112u) << text;  // closing brackets may follow the last value
  }
}

TEST(JsonEdit, RemovesMembersAndKeepsComments) {
  EXPECT_EQ(without("{ \"a\": 1, \"b\": 2 }", "a"), "{ \"b\": 2 }");
  EXPECT_EQ(without("{ \"a\": 1, \"b\": 2 }", "b"), "{ \"a\": 1 }");
  EXPECT_EQ(without("{ \"a\": 1 }", "a"), "{ }");
  EXPECT_EQ(without("{\n  \"a\": 1,\n  \"b\": 2\n}", "b"), "{\n  \"a\": 1\n}");
  EXPECT_EQ(without("{\n  \"a\": 1,\n  \"b\": 2\n}", "a"), "{\n  \"b\": 2\n}");
  EXPECT_EQ(without("{\n  \"a\": 1, // one\n  \"b\": 2 // two\n}", "b"), "{\n  \"a\": 1 // one\n  // two\n}");
  EXPECT_EQ(without("{ \"a\": 1 /* one */ , \"b\": 2 }", "a"), "{ /* one */  \"b\": 2 }");
}

TEST(JsonEdit, WritesEveryNumberSoThatItIsReadBack) {
  for (const double x :
       {0.1, -0.0, 1e-310, 1.7976931348623157e308, 12345678901234567890.0, 1.0 / 3.0, -5e22}) {
    JsonEdit e = edit("{ \"a\": 1 }");
    e.set({"a"}, x);
    const JsonValue read = edit(e.text()).value({"a"});
    EXPECT_EQ(*read.number(), x);
    EXPECT_EQ(std::signbit(*read.number()), std::signbit(x));
  }
}

}  // namespace
}  // namespace blendwright::test
