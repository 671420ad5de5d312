// The schema of a scene accepts what the program reads, and nothing that the reader refuses for its keys.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "app/json/scene_keys.hpp"
#include "app/json/scene_reader.hpp"
#include "tests/app/mini_schema.hpp"
#include "tests/app/program.hpp"

namespace blendwright::test {
namespace {

using testing::IsEmpty;
using testing::Not;
using Type = NodeParam::Type;

const MiniSchema& schema() {
  static const MiniSchema scene(scene_schema());
  return scene;
}

std::vector<std::string> violations(const std::string& text) { return schema().violations(parse_json(text)); }

TEST(SceneSchema, AcceptsEveryExample) {
  std::size_t seen = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/scenes")) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path());
    EXPECT_THAT(violations(content(entry.path())), IsEmpty());
    ++seen;
  }
  EXPECT_GE(seen, 10u);
}

TEST(SceneSchema, RefusesWhatTheReaderRefusesForItsForm) {
  const std::string ball = R"({ "kind": "lp_metric", "a": 2, "b": 2, "c": 2, "n": 2 })";
  EXPECT_THAT(violations("{ \"solid\": " + ball + " }"), IsEmpty());
  EXPECT_THAT(violations("{ \"solid\": " + ball + ", \"adjust\": { \"/solid/a\": [1, \"2*pi\"] } }"),
              IsEmpty());
  for (const char* solid :
       {"3", "[]", "{}", R"({ "kind": "lp_metrc", "a": 2, "b": 2, "c": 2, "n": 2 })",
        R"({ "kind": "lp_metric", "a": 2, "b": 2, "c": 2 })",
        R"({ "kind": "lp_metric", "a": 0, "b": 2, "c": 2, "n": 2 })",
        R"({ "kind": "lp_metric", "a": true, "b": 2, "c": 2, "n": 2 })",
        R"({ "kind": "lp_metric", "a": 2, "b": 2, "c": 2, "n": 2, "d": 2 })",
        R"({ "kind": "plane", "a": 1, "normal": [0, 1] })", R"({ "kind": "soft_object", "distance": 4 })",
        R"({ "kind": "soft_object", "distance": "a", "potential": "blank" })",
        R"({ "kind": "soft_object", "distance": "a", "softness": -1 })",
        R"({ "kind": "soft_object", "distance": "a", "w1": { "contur": "b" } })",
        R"({ "kind": "soft_blend", "of": [] })", R"({ "kind": "soft_blend", "of": ["a", {}] })",
        R"({ "kind": "affine", "of": "a", "matrix": [[1, 0, 0], [0, 1, 0], [0, 0, 1]] })"}) {
    SCOPED_TRACE(solid);
    EXPECT_THAT(violations(std::string("{ \"solid\": ") + solid + " }"), Not(IsEmpty()));
  }
  for (const char* text :
       {"[]", "{}", R"({ "solid": "a", "units": "mm" })", R"({ "solid": "a", "unit": "mile" })",
        R"({ "solid": "a", "nodes": [] })", R"({ "solid": "a", "nodes": { "a": "b" } })",
        R"({ "solid": "a", "strict": 1 })", R"({ "solid": "a", "adjust": [] })",
        R"({ "solid": "a", "adjust": { "a/b": 1 } })", R"({ "solid": "a", "adjust": { "a/b": [1, 2, 3] } })"})
    EXPECT_THAT(violations(text), Not(IsEmpty())) << text;
}

TEST(SceneSchema, ListsTheKeysOfEveryKind) {
  EXPECT_GE(node_kinds().size(), 20u);
  for (const NodeKind* kind : node_kinds()) {
    SCOPED_TRACE(kind->name);
    const JsonValue* definition = schema().root().find("$defs")->find("node." + std::string(kind->name));
    ASSERT_NE(definition, nullptr);
    std::vector<std::string> listed, keys{"kind"};
    for (const JsonMember& p : *definition->find("properties")->members()) listed.push_back(p.key);
    for (const NodeParam& p : kind->params) keys.emplace_back(p.info.name);
    EXPECT_EQ(listed, keys);
  }
}

/// A value that a parameter may have.
JsonValue sample(const NodeParam& p) {
  const double middle = std::isfinite(p.info.fallback)         ? p.info.fallback
                        : p.info.min < 2.0 && p.info.max > 2.0 ? 2.0
                                                               : 0.5 * (p.info.min + p.info.max);
  const auto list = [](std::size_t n, const JsonValue& item) { return JsonValue(JsonValue::Array(n, item)); };
  switch (p.type) {
    case Type::number:
    case Type::integer:
    case Type::number_or_contour:
      return middle;
    case Type::word:
      return p.words.front();
    case Type::point:
      return JsonValue::array({1.0, 0.0, 0.0});
    case Type::points:
      return list(1, list(3, 1.0));
    case Type::numbers:
      return list(std::max<std::size_t>(p.count, 1), 1.0);
    case Type::rows:
      return list(p.count, list(p.columns, 1.0));
    case Type::formulas:
      return list(p.count, "t");
    case Type::node:
      return "other";
    case Type::nodes:
      return list(std::max<std::size_t>(p.count, 1), "other");
  }
  return {};
}

TEST(SceneSchema, AgreesWithTheReaderOnTheKeysOfEveryKind) {
  for (const NodeKind* kind : node_kinds()) {
    SCOPED_TRACE(kind->name);
    JsonValue node = JsonValue::object({{"kind", kind->name}});
    for (const NodeParam& p : kind->params) node.add(std::string(p.info.name), sample(p));
    EXPECT_THAT(schema().violations(JsonValue::object({{"solid", node}})), IsEmpty()) << json_text(node);
    for (const NodeParam& p : kind->params) {
      JsonValue without = JsonValue::object({{"kind", kind->name}});
      for (const NodeParam& other : kind->params)
        if (&other != &p) without.add(std::string(other.info.name), sample(other));
      // Missing keys are the scene's business, and a schema's.
      bool missing = false;
      try {
        static_cast<void>(build_scene_text(json_text(JsonValue::object({{"solid", without}})), "x.json"));
      } catch (const InputError& e) {
        for (const Problem& problem : e.problems())
          missing = missing || (problem.where == "/solid/" + std::string(p.info.name) &&
                                problem.message.find("is missing") != std::string::npos);
      }
      EXPECT_EQ(missing, !schema().violations(JsonValue::object({{"solid", without}})).empty())
          << p.info.name;
      EXPECT_EQ(missing, is_required(p)) << p.info.name;
    }
  }
}

}  // namespace
}  // namespace blendwright::test
