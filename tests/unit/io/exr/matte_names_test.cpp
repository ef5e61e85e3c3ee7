#include <bit>
#include <cmath>

#include "base/error.h"
#include "io/exr/mattes.h"
#include "support/catch.h"
#include "support/mattes.h"
#include "support/message_of.h"

namespace matte_names_test {

using namespace thermal;

namespace {

/// Index of a name's object; -1 for none.
int index_of(const MatteNames& names, std::string_view name) {
  const MatteNames::Matte* matte = names.find(name);
  return matte != nullptr ? matte->index : -1;
}

std::string fault_of(const std::vector<ManifestObject>& objects) {
  return message_of<DataError>([&] { (void)MatteNames(objects); });
}

}  // namespace

TEST_CASE("Names have the same hashes as in other programs") {
  // Specification 1.2.0, "Metadata"; tests of the Cryptomatte project's plug-in for Nuke, which cover names of every
  // length modulo 4 and of letters beyond ASCII; a file that Blender 3.4.1 wrote.
  CHECK(cryptomatte_hash("bunny") == 0x13851A76);
  CHECK(cryptomatte_hash("default") == 0x42C9679F);
  CHECK(cryptomatte_hash("bunny_porcelain_mat") == 0xB24B26D4);
  CHECK(std::bit_cast<float>(cryptomatte_hash("hello")) == 6.0705627102400005616e-17F);
  CHECK(std::bit_cast<float>(cryptomatte_hash("равнина")) == -1.3192631212399999468e-25F);
  CHECK(std::bit_cast<float>(cryptomatte_hash("mädchen")) == 6.2361298211599995797e+25F);
  CHECK(cryptomatte_hash("elephant") == 0xC0A151D2);
  CHECK(cryptomatte_hash("walker.001") == 0x2984D80F);
  CHECK(cryptomatte_hash("Fell Ä") == 0x4CBBB188);
}

TEST_CASE("A hash that would not be a normal float has its exponent changed") {
  CHECK(cryptomatte_hash("tree_169") == 0x808CB812);   // MurmurHash3: 800cb812, denormal
  CHECK(cryptomatte_hash("tree_97") == 0xFF6ED3B0);    // ffeed3b0, NaN
  CHECK(cryptomatte_hash("tree_2049") == 0x7F36901A);  // 7fb6901a, NaN
  CHECK(hash_in_float(0) == 0x00800000);
  for (const std::uint32_t hash : {0U, 0x80000000U, 0x7F800000U, 0xFFFFFFFFU, 0x00800000U, 0x7F000000U}) {
    CHECK(std::isnormal(std::bit_cast<float>(hash_in_float(hash))));
    CHECK(hash_in_float(hash_in_float(hash)) == hash_in_float(hash));
  }
}

TEST_CASE("A star matches any letters, or none") {
  CHECK(matches_matte("tree_*", "tree_12"));
  CHECK(matches_matte("tree_*", "tree_"));
  CHECK_FALSE(matches_matte("tree_*", "tree"));
  CHECK_FALSE(matches_matte("tree_*", "a tree_12"));
  CHECK(matches_matte("*", ""));
  CHECK(matches_matte("**", "x"));
  CHECK(matches_matte("*.00*", "leg.001"));
  CHECK(matches_matte("*ab*b", "aabaabb"));
  CHECK_FALSE(matches_matte("*ab*c", "aabaabb"));
  CHECK_FALSE(matches_matte("", "x"));
  CHECK(matches_matte("", ""));
  CHECK_FALSE(matches_matte("x", ""));
  CHECK_FALSE(matches_matte("t?ee", "tree"));
  const std::string many(20000, 'a');  // a matcher that backtracks for every star would never end
  CHECK_FALSE(matches_matte("*a*a*a*a*a*a*a*a*a*a*b", many));
}

TEST_CASE("An object's mattes are those it lists, or its name") {
  const MatteNames names(std::vector{matte_object(1, "ground", {"soil", "stone_*"}), matte_object(7, "anna"),
                                     matte_object(8, "a*a")});
  CHECK(index_of(names, "soil") == 1);
  CHECK(index_of(names, "stone_7") == 1);
  CHECK(index_of(names, "ground") == -1);
  CHECK(index_of(names, "anna") == 7);
  CHECK(index_of(names, "a*a") == 8);
  CHECK(index_of(names, "aha") == -1);  // a name is not a pattern
  CHECK(names.texts() == std::vector<std::string>{"soil", "stone_*", "anna", "a*a"});
}

TEST_CASE("A name takes precedence over a pattern") {
  const MatteNames names(std::vector{matte_object(1, "stones", {"stone_*"}), matte_object(2, "stone_7")});
  CHECK(index_of(names, "stone_7") == 2);
  CHECK(index_of(names, "stone_8") == 1);
}

TEST_CASE("A hash of unknown name is compared with those of the names") {
  const MatteNames names(std::vector{matte_object(1, "stones", {"stone_*"}), matte_object(2, "anna")});
  REQUIRE(names.find_hash(cryptomatte_hash("anna")) != nullptr);
  CHECK(names.find_hash(cryptomatte_hash("anna"))->index == 2);
  CHECK(names.find_hash(cryptomatte_hash("stone_*")) == nullptr);
  CHECK(names.find_hash(0) == nullptr);
}

TEST_CASE("A name of two objects is an error that names both") {
  CHECK(fault_of({matte_object(1, "anna"), matte_object(2, "ben", {"x", "anna"})}) ==
        "objects[1].mattes[1] = \"anna\"; expected a unique name, but objects[0].name is \"anna\"");
  CHECK(fault_of({matte_object(1, "a", {"t_*"}), matte_object(2, "b", {"t_*"})}) ==
        "objects[1].mattes[0] = \"t_*\"; expected a unique name, but objects[0].mattes[0] is \"t_*\"");
  CHECK(fault_of({matte_object(1, "anna", {"anna", "anna", "t_*", "t_*"})}) == "(no fault was thrown)");
}

TEST_CASE("Names with equal hashes cannot belong to two objects") {
  CHECK(fault_of({matte_object(1, "stone_76992"), matte_object(2, "stone_81521")}) ==
        "objects[1].name = \"stone_81521\"; expected a unique hash, but objects[0].name is \"stone_76992\"");
}

TEST_CASE("A name that matches patterns of two objects is an error that names both") {
  const MatteNames names(
      std::vector{matte_object(1, "stones", {"stone_*", "s*"}), matte_object(2, "sevens", {"*_7"})});
  CHECK(index_of(names, "stone_8") == 1);  // by two of one object's
  CHECK(message_of<DataError>([&] { (void)names.find("stone_7"); }) ==
        "expected a name of one object, but stones's \"stone_*\" and sevens's \"*_7\" match it");
}

}  // namespace matte_names_test
