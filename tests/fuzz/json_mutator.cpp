// Mutates JSON as a tree, so that the result is still JSON: randomly changed bytes seldom are, and few would pass the
// parser. One time in four, and always if the input is not JSON, libFuzzer mutates bytes as usual.
// - Half of the time it starts from an input that the reader accepted, if the target keeps these.
// - JSON may end at a NUL byte, behind which arrays lie. One time in four these are changed instead, mostly without a
//   change of their size, which the JSON gives.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fuzz/accepted.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

using Json = nlohmann::ordered_json;
using Random = std::minstd_rand;

const std::vector<Json> kOdd = {nullptr,
                                true,
                                0,
                                1,
                                -1,
                                0.5,
                                2147483648,
                                -2147483649,
                                4294967296,
                                18446744073709551615U,
                                1e308,
                                -1e308,
                                5e-324,
                                "",
                                "../x",
                                "/x",
                                "*",
                                "0",
                                std::string(300, 'x'),
                                Json::array(),
                                Json::object(),
                                Json::array({Json::array()})};

/// Every value of a document, itself first.
void collect(Json& value, std::vector<Json*>& places) {
  places.push_back(&value);
  if (!value.is_structured()) return;
  for (auto& part : value) collect(part, places);
}

template <typename T>
const T& one_of(const std::vector<T>& choices, Random& random) {
  return choices[random() % choices.size()];
}

Json changed_text(const std::string& text) {
  std::vector<std::uint8_t> bytes(text.begin(), text.end());
  bytes.resize(text.size() + 16);
  bytes.resize(LLVMFuzzerMutate(bytes.data(), text.size(), bytes.size()));
  return std::string(bytes.begin(), bytes.end());
}

Json changed_leaf(const Json& value, Random& random) {
  if (value.is_string()) return changed_text(value.get<std::string>());
  if (value.is_number_integer()) return value.get<std::int64_t>() ^ (std::int64_t{1} << random() % 63);
  if (value.is_number_float()) return value.get<double>() * (random() % 2 == 0 ? -1.5 : 1e3);
  return one_of(kOdd, random);
}

void erase_part(Json& value, Random& random) {
  if (value.empty()) return;
  value.erase(std::next(value.begin(), static_cast<std::ptrdiff_t>(random() % value.size())));
}

void add_part(Json& value, const Json& part, const std::string& key) {
  if (value.is_array()) value.push_back(part);
  if (value.is_object()) value[key] = part;
}

/// Keys of any of these objects.
std::vector<std::string> keys_of(const std::vector<Json*>& places) {
  std::vector<std::string> keys = {"x"};
  for (const Json* place : places) {
    if (!place->is_object()) continue;
    for (const auto& [key, value] : place->items()) keys.push_back(key);
  }
  return keys;
}

void change(Json& document, Random& random) {
  std::vector<Json*> places;
  collect(document, places);
  Json& value = *one_of(places, random);
  const Json other = random() % 2 == 0 ? one_of(kOdd, random) : *one_of(places, random);
  const bool structured = value.is_structured();
  switch (random() % 4) {
    case 0:
      value = other;
      return;
    case 1:
      return structured ? erase_part(value, random) : void(value = changed_leaf(value, random));
    case 2:
      return structured ? add_part(value, other, one_of(keys_of(places), random)) : void(value = other);
    default:
      if (!structured) value = changed_leaf(value, random);
  }
}

/// Half of the time replaces the input by one that was accepted. Returns its size.
std::size_t choose_input(std::uint8_t* data, std::size_t size, std::size_t most, Random& random) {
  const auto& accepted = AcceptedInputs::instance().all();
  if (accepted.empty() || random() % 2 == 0) return size;
  const std::vector<std::uint8_t>& chosen = one_of(accepted, random);
  if (chosen.size() > most) return size;
  std::ranges::copy(chosen, data);
  return chosen.size();
}

/// The arrays behind the JSON, mostly without a change of their size.
std::size_t change_arrays(std::uint8_t* data, std::size_t size, std::size_t most, Random& random) {
  if (random() % 8 == 0) return LLVMFuzzerMutate(data, size, most);
  (void)LLVMFuzzerMutate(data, size, size);
  return size;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  Random random(seed);
  size = choose_input(data, size, most, random);
  std::uint8_t* const end = std::find(data, data + size, 0);  // of the JSON
  const std::vector<std::uint8_t> rest(end, data + size);     // a NUL byte and the arrays, if there are any
  const auto length = static_cast<std::size_t>(end - data);
  Json document = Json::parse(data, end, nullptr, false);
  const bool plain = random() % 4 == 0;
  if (rest.size() > 1 && random() % 4 == 0)
    return length + 1 + change_arrays(end + 1, rest.size() - 1, most - length - 1, random);
  if (plain || document.is_discarded()) return LLVMFuzzerMutate(data, size, most);
  for (unsigned k = 0; k <= seed % 3; ++k) change(document, random);
  const std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() + rest.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::ranges::copy(rest, std::ranges::copy(text, data).out);
  return text.size() + rest.size();
}
