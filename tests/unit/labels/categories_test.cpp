#include "labels/label_set.h"
#include "support/catch.h"

namespace categories_test {

using namespace thermal;

TEST_CASE("A known category has the same id in every dataset") {
  const auto none = number_categories({});
  const auto some = number_categories({"zebra", "antelope"});
  CHECK(none.at("human") == 1);
  CHECK(none.at("elephant") == 2);
  CHECK(none.at("vehicle") == 10);
  CHECK(none.at("cattle") == 11);
  CHECK(none.at("wildebeest") == 18);
  for (const auto& [name, id] : none) CHECK(some.at(name) == id);
}

TEST_CASE("Unknown categories follow in alphabetical order") {
  const auto ids = number_categories({"okapi", "human", "antelope"});
  CHECK(ids.at("antelope") == 19);
  CHECK(ids.at("okapi") == 20);
  CHECK(ids.size() == 20);
}

}  // namespace categories_test
