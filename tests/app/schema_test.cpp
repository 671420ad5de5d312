// The schemas accept what the program reads and writes, and nothing that the reader refuses for its keys.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/json/job_keys.hpp"
#include "app/json/job_reader.hpp"
#include "app/json/report_objects.hpp"
#include "tests/app/mini_schema.hpp"
#include "tests/app/program.hpp"

namespace blendwright::test {
namespace {

using testing::IsEmpty;
using testing::Not;

fs::path examples() { return fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/specs"; }

const MiniSchema& job() {
  static const MiniSchema schema(job_schema());
  return schema;
}

TEST(JobSchema, AcceptsEveryExample) {
  std::size_t seen = 0;
  for (const auto& entry : fs::directory_iterator(examples())) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path());
    EXPECT_THAT(job().violations(parse_json(content(entry.path()))), IsEmpty());
    ++seen;
  }
  EXPECT_GE(seen, 10u);
}

TEST(JobSchema, RefusesWhatTheReaderRefusesForItsForm) {
  // Contradictions and values of formulas are beyond a schema; wrong types, keys and words are not.
  for (const char* name :
       {"wrong-type-radius", "wrong-type-range", "wrong-type-closed", "wrong-type-primaries",
        "missing-radius", "missing-to", "missing-kind", "unknown-kind", "unknown-trimline-kind",
        "unknown-key", "unknown-continuity", "unknown-format", "unknown-unit", "negative-radius",
        "negative-tension", "tangent-angle-too-large", "tolerance-zero", "not-an-object"}) {
    SCOPED_TRACE(name);
    const fs::path file =
        fs::path(BLENDWRIGHT_SOURCE_DIR) / "tests/data/specs/bad" / (std::string(name) + ".json");
    EXPECT_THAT(job().violations(parse_json(content(file))), Not(IsEmpty()));
  }
}

/// The keys of a definition, in its order.
std::vector<std::string> property_names(const JsonValue& definition) {
  std::vector<std::string> names;
  for (const JsonMember& p : *definition.find("properties")->members()) names.push_back(p.key);
  return names;
}

std::vector<std::string> key_names(const ObjectInfo& object) {
  std::vector<std::string> names;
  for (const KeyInfo& k : object.keys) names.push_back(k.name);
  return names;
}

TEST(JobSchema, ListsTheKeysOfTheReadersTables) {
  for (const ObjectInfo& object : job_objects()) {
    SCOPED_TRACE(object.name);
    std::string name = object.name;
    for (char& c : name)
      if (c == ' ') c = '.';
    const JsonValue* definition =
        object.name == "job" ? &job().root() : job().root().find("$defs")->find(name);
    ASSERT_NE(definition, nullptr);
    EXPECT_EQ(property_names(*definition), key_names(object));
  }
  EXPECT_GE(job_objects().size(), primary_kinds().size() + 10);
}

TEST(JobSchema, EveryReferenceResolves) {
  // A value that no branch refuses early: an object that uses every definition is not needed, each is checked
  // alone.
  const JsonValue nothing;
  for (const JsonMember& definition : *job().root().find("$defs")->members()) {
    SCOPED_TRACE(definition.key);
    const MiniSchema alone(json_text(
        JsonValue::object({{"$ref", "#/$defs/" + definition.key}, {"$defs", *job().root().find("$defs")}})));
    for (const char* sample :
         {"null", "1", "\"x\"", "[1, 1, 1]", "[[1, 1], [1, 1]]", "{\"kind\": \"plane\"}"})
      EXPECT_NO_THROW(static_cast<void>(alone.violations(parse_json(sample))));
  }
}

TEST(ReportSchema, ListsTheFieldsOfTheWriter) {
  const MiniSchema schema(report_schema());
  for (const ObjectInfo& object : report_objects()) {
    SCOPED_TRACE(object.name);
    const JsonValue* definition =
        object.name == "report" ? &schema.root() : schema.root().find("$defs")->find(object.name);
    ASSERT_NE(definition, nullptr);
    EXPECT_EQ(property_names(*definition), key_names(object));
  }
}

}  // namespace
}  // namespace blendwright::test
