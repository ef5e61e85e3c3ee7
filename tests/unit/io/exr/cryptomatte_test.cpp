#include "io/exr/cryptomatte.h"

#include <filesystem>

#include "base/error.h"
#include "base/relative_name.h"
#include "support/catch.h"
#include "support/mattes.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace cryptomatte_test {

using namespace thermal;

namespace {

/// "ViewLayer.CryptoObject00.r": all but the last component is the pass.
ExrChannel channel(const std::string& name, const std::string& type = "float",
                   const std::string& compression = "ZIP") {
  const std::size_t dot = name.rfind('.');
  return {.part = 0,
          .name = name,
          .layer = "",
          .pass = name.substr(0, dot),
          .component = name.substr(dot + 1),
          .type = type,
          .compression = compression};
}

/// A file of cryptomattes of one layer each.
ExrHeader header_of(const std::vector<std::string>& names) {
  ExrHeader header;
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (const char* component : {"r", "g", "b", "a"})
      header.channels.push_back(channel(fmt::format("{}00.{}", names[i], component)));
    for (const auto& [attribute, text] : matte_texts({"anna"}, names[i], fmt::format("{:07x}", i)))
      header.texts.emplace(attribute, text);
  }
  return header;
}

const std::string kName = "ViewLayer.CryptoObject";

/// The fault of the only cryptomatte of a file after `change` is applied to its header.
template <typename Change>
std::string fault_after(const Change& change) {
  ExrHeader header = header_of({kName});
  change(header);
  const std::vector<Cryptomatte> found = cryptomattes_in(header);
  REQUIRE(found.size() == 1);
  return found.front().fault;
}

/// The fault of a text of the metadata.
std::string fault_of(const std::string& field, const std::string& value) {
  return fault_after([&](ExrHeader& header) { header.texts["cryptomatte/0000000/" + field] = value; });
}

std::vector<std::string> names_of(const std::vector<const ExrChannel*>& channels) {
  std::vector<std::string> names;
  for (const ExrChannel* each : channels) names.push_back(each->name);
  return names;
}

std::vector<Cryptomatte> named(const std::vector<std::string>& names) {
  std::vector<Cryptomatte> cryptomattes;
  for (const std::string& name : names)
    cryptomattes.push_back({.name = name, .names = {}, .channels = {}, .names_fault = "", .fault = ""});
  return cryptomattes;
}

std::string chosen(const std::vector<std::string>& names, const std::string& wanted,
                   const std::string& layer = "") {
  const std::vector<Cryptomatte> all = named(names);
  return choose_cryptomatte(all, wanted, layer).name;
}

std::string fault_of_choice(const std::vector<std::string>& names, const std::string& wanted) {
  return message_of<DataError>([&] { (void)chosen(names, wanted); });
}

}  // namespace

TEST_CASE("A cryptomatte is found by its metadata") {
  const ExrHeader header = header_of({"ViewLayer.CryptoObject", "ViewLayer.CryptoMaterial"});
  const std::vector<Cryptomatte> found = cryptomattes_in(header);
  REQUIRE(found.size() == 2);
  CHECK(found[0].name == "ViewLayer.CryptoMaterial");
  CHECK(found[1].name == "ViewLayer.CryptoObject");
  CHECK(found[1].fault.empty());
  CHECK(found[1].names == std::map<std::uint32_t, std::string>{{cryptomatte_hash("anna"), "anna"}});
  CHECK(names_of(found[1].channels) ==
        std::vector<std::string>{"ViewLayer.CryptoObject00.r", "ViewLayer.CryptoObject00.g",
                                 "ViewLayer.CryptoObject00.b", "ViewLayer.CryptoObject00.a"});
}

TEST_CASE("A file without metadata has none, whatever its channels are named") {
  ExrHeader header = header_of({kName});
  header.texts = {
      {"cryptomatte", "x"}, {"cryptomatte/", "x"}, {"comment", "cryptomatte/0000000/name"}, {"a/b/c", "x"}};
  CHECK(cryptomattes_in(header).empty());
}

TEST_CASE("Metadata may have the prefix of other programs") {
  ExrHeader header = header_of({kName});
  ExrTexts texts;
  for (const auto& [attribute, text] : header.texts) texts.emplace("exr/" + attribute, text);
  header.texts = texts;
  REQUIRE(cryptomattes_in(header).size() == 1);
  CHECK(cryptomattes_in(header).front().fault.empty());
}

TEST_CASE("Components have several spellings, and the preview picture is none of them") {
  for (const std::vector<std::string>& spelt :
       {std::vector<std::string>{"R", "G", "B", "A"}, {"red", "green", "blue", "alpha"}}) {
    ExrHeader header = header_of({kName});
    header.channels = {channel(kName + ".R"), channel(kName + ".r"), channel(kName + "x.r"),
                       channel(kName + "000.r")};
    for (const char* layer : {"01", "00"}) {
      for (const std::string& component : spelt)
        header.channels.push_back(channel(fmt::format("{}{}.{}", kName, layer, component)));
    }
    const std::vector<Cryptomatte> found = cryptomattes_in(header);
    CHECK(found.front().fault.empty());
    REQUIRE(found.front().channels.size() == 8);
    CHECK(found.front().channels.front()->name == fmt::format("{}00.{}", kName, spelt[0]));
    CHECK(found.front().channels.back()->name == fmt::format("{}01.{}", kName, spelt[3]));
  }
}

TEST_CASE("The last layer may have a single rank") {
  CHECK(fault_after([](ExrHeader& header) {
          header.channels.push_back(channel(kName + "01.r"));
          header.channels.push_back(channel(kName + "01.g"));
        }).empty());
}

TEST_CASE("Hashes of a manifest are reported as stored in floats") {
  ExrHeader header = header_of({kName});
  header.texts["cryptomatte/0000000/manifest"] = R"({"tree_97": "ffeed3b0", "name \"Ä\"": "4CBBB188"})";
  CHECK(cryptomattes_in(header).front().names ==
        std::map<std::uint32_t, std::string>{{0xFF6ED3B0, "tree_97"}, {0x4CBBB188, "name \"Ä\""}});
}

TEST_CASE("A cryptomatte may come without names") {
  ExrHeader header = header_of({kName});
  header.texts.erase("cryptomatte/0000000/manifest");
  header.texts["cryptomatte/0000000/manif_file"] = "../../etc/names.json";
  CHECK(cryptomattes_in(header).front().fault.empty());
  CHECK(cryptomattes_in(header).front().names.empty());
}

TEST_CASE("Names may be in a side-car file below the folder, and those of the header come first") {
  const TestFolder folder;
  std::filesystem::create_directory(folder.path() / "names");
  (void)folder.file("names/f.json", R"({"cow": "2b4855d1"})");
  ExrHeader header = header_of({kName});
  header.folder = folder.path();
  header.texts["cryptomatte/0000000/manif_file"] = "names/f.json";
  CHECK(cryptomattes_in(header).front().names.begin()->second == "anna");
  header.texts.erase("cryptomatte/0000000/manifest");
  const Cryptomatte cryptomatte = cryptomattes_in(header).front();
  CHECK(cryptomatte.names == std::map<std::uint32_t, std::string>{{0x2B4855D1, "cow"}});
  CHECK(cryptomatte.names_fault.empty());
}

TEST_CASE("A side-car file that cannot be read, or is elsewhere, leaves a cryptomatte without names") {
  const TestFolder folder;
  const std::string place = folder.path().string();
  (void)folder.file("list.json", R"(["cow"])");
  std::filesystem::resize_file(folder.file("long.json", ""), kMostSidecarBytes + 1);
  std::filesystem::create_symlink("/etc", folder.path() / "elsewhere");
  std::filesystem::create_symlink("list.json", folder.path() / "link.json");
  const auto fault_of_sidecar = [&folder](const std::string& name) {
    ExrHeader header = header_of({kName});
    header.folder = folder.path();
    header.texts.erase("cryptomatte/0000000/manifest");
    header.texts["cryptomatte/0000000/manif_file"] = name;
    const Cryptomatte cryptomatte = cryptomattes_in(header).front();
    CHECK(cryptomatte.fault.empty());
    CHECK(cryptomatte.names.empty());
    return cryptomatte.names_fault;
  };
  CHECK(fault_of_sidecar("none.json") ==
        "manif_file = \"none.json\": cannot read " + place + "/none.json: no such file");
  CHECK(fault_of_sidecar("list.json") ==
        "manif_file = \"list.json\": manifest = 7 characters; expected a JSON object of names and their "
        "hashes");
  CHECK(fault_of_sidecar("long.json") ==
        "manif_file = \"long.json\": " + place +
            "/long.json = 16777217 bytes; expected at most 16777216 bytes (16 MiB)");
  CHECK(fault_of_sidecar("elsewhere/passwd")
            .starts_with("manif_file = \"elsewhere/passwd\": " + place + "/elsewhere = a link to /etc; "));
  CHECK(fault_of_sidecar("link.json")
            .starts_with("manif_file = \"link.json\": " + place + "/link.json = a link to list.json; "));
  for (const char* name : {"../names.json", "/etc/passwd", "a/../../b", "~/\x1b[2J"})
    CHECK(fault_of_sidecar(name).ends_with(std::string(": expected ") + RelativeName::kRule));
  CHECK(fault_of_sidecar("\x1b[2J").starts_with("manif_file = \"\\x1b[2J\": "));
}

TEST_CASE("The fault of a cryptomatte is reported with it") {
  CHECK(fault_of("hash", "md5") ==
        "cryptomatte ViewLayer.CryptoObject: hash = \"md5\"; expected \"MurmurHash3_32\"");
  CHECK(fault_of("conversion", "uint32_to_float64") ==
        "cryptomatte ViewLayer.CryptoObject: conversion = \"uint32_to_float64\"; expected "
        "\"uint32_to_float32\"");
  CHECK(fault_after([](ExrHeader& header) { header.texts.erase("cryptomatte/0000000/conversion"); }) ==
        "cryptomatte ViewLayer.CryptoObject: conversion = \"\"; expected \"uint32_to_float32\"");
  CHECK(fault_after([](ExrHeader& header) { header.texts.erase("cryptomatte/0000000/name"); }) ==
        "cryptomatte with the key 0000000: no name; expected that of its channels");
  CHECK(fault_of("name", "Other") ==
        "cryptomatte Other: no channels; expected Other00.r, Other00.g and so on");
}

TEST_CASE("An invalid manifest leaves a cryptomatte without names") {
  const auto fault_of_names = [](const std::string& manifest) {
    ExrHeader header = header_of({kName});
    header.texts["cryptomatte/0000000/manifest"] = manifest;
    const Cryptomatte cryptomatte = cryptomattes_in(header).front();
    CHECK(cryptomatte.fault.empty());
    CHECK(cryptomatte.names.empty());
    CHECK(cryptomatte.channels.size() == 4);
    return cryptomatte.names_fault;
  };
  for (const char* text : {R"({"anna": "1234)", R"(["anna"])", "anna", "{\"\xFF\": \"12345678\"}",
                           R"({"Haut "zart"":"90d59f7a"})"}) {  // the last from Blender 3.4.1
    CHECK(fault_of_names(text) ==
          fmt::format("manifest = {} characters; expected a JSON object of names and their hashes",
                      std::string(text).size()));
  }
  CHECK(fault_of_names(std::string(100000, '[')) ==
        "manifest = 100000 characters; expected a JSON object of names and their hashes");
  for (const char* digits : {"1234567", "123456789", "1234567g", "-1234567", "0x123456", ""}) {
    CHECK(fault_of_names(fmt::format("{{\"anna\": \"{}\"}}", digits)) ==
          fmt::format("manifest[\"anna\"] = \"{}\"; expected a hash of eight hexadecimal digits", digits));
  }
  CHECK(fault_of_names(R"({"anna": 12345678.5})") ==
        "manifest[\"anna\"] = \"12345678.5\"; expected a hash of eight hexadecimal digits");
}

TEST_CASE("A rank without hash or coverage is an error") {
  CHECK(fault_after([](ExrHeader& header) { header.channels.push_back(channel(kName + "02.r")); }) ==
        "cryptomatte ViewLayer.CryptoObject: no channel ViewLayer.CryptoObject01.r; expected hash and "
        "coverage of "
        "every rank up to ViewLayer.CryptoObject02.r");
  CHECK(fault_after([](ExrHeader& header) { header.channels.pop_back(); }) ==
        "cryptomatte ViewLayer.CryptoObject: no channel ViewLayer.CryptoObject00.a; expected hash and "
        "coverage of "
        "every rank up to ViewLayer.CryptoObject00.b");
}

TEST_CASE("More ranks than any program writes are an error, not a memory problem") {
  CHECK(fault_after([](ExrHeader& header) { header.channels.push_back(channel(kName + "16.g")); }) ==
        "cryptomatte ViewLayer.CryptoObject: ranks = 33; expected at most 32");
}

TEST_CASE("Hashes must keep their bits") {
  CHECK(fault_after([](ExrHeader& header) { header.channels[2].type = "half"; }) ==
        "cryptomatte ViewLayer.CryptoObject: ViewLayer.CryptoObject00.b: type = half; expected float, whose "
        "bits are "
        "the hashes of names");
  CHECK(fault_after([](ExrHeader& header) { header.channels[1].type = "half"; }).empty());  // a coverage
  for (const char* lossy : {"PXR24", "B44", "B44A", "DWAA", "DWAB"}) {
    CHECK(
        fault_after([&](ExrHeader& header) { header.channels[0].compression = lossy; }) ==
        fmt::format(
            "cryptomatte ViewLayer.CryptoObject: ViewLayer.CryptoObject00.r: compression = {}; expected one "
            "that keeps the bits of hashes: none, RLE, ZIPS, ZIP or PIZ",
            lossy));
  }
  for (const char* lossless : {"none", "RLE", "ZIPS", "ZIP", "PIZ"}) {
    CHECK(fault_after([&](ExrHeader& header) { header.channels[0].compression = lossless; }).empty());
  }
}

TEST_CASE("A cryptomatte is selected by its whole name or without its layer") {
  const std::vector<std::string> names = {"CryptoMaterial", "Fog.CryptoObject", "ViewLayer.CryptoObject"};
  CHECK(chosen(names, "CryptoMaterial") == "CryptoMaterial");
  CHECK(chosen(names, "Fog.CryptoObject") == "Fog.CryptoObject");
  CHECK(chosen(names, "CryptoObject", "ViewLayer") == "ViewLayer.CryptoObject");
  CHECK(chosen({"Fog.CryptoMaterial", "ViewLayer.CryptoObject"}, "CryptoObject") == "ViewLayer.CryptoObject");
  CHECK(chosen({"CryptoObject", "Fog.CryptoObject"}, "CryptoObject") == "CryptoObject");
  CHECK(chosen({"CryptoObject", "Fog.CryptoObject"}, "CryptoObject", "Fog") == "CryptoObject");
}

TEST_CASE("An invalid choice lists the available ones") {
  CHECK(fault_of_choice({"Fog.CryptoObject", "ViewLayer.CryptoObject"}, "CryptoObject") ==
        "cryptomatte = \"CryptoObject\"; expected the whole name of one: Fog.CryptoObject, "
        "ViewLayer.CryptoObject");
  CHECK(fault_of_choice({"Fog.CryptoMaterial", "Fog.CryptoObject"}, "CryptoObjekt") ==
        "cryptomatte = \"CryptoObjekt\"; expected one that the file has: Fog.CryptoMaterial, "
        "Fog.CryptoObject; did you "
        "mean \"CryptoObject\"?");
  CHECK(fault_of_choice({}, "CryptoObject") ==
        "cryptomatte = \"CryptoObject\"; expected a file with cryptomattes; this one has none");
}

TEST_CASE("An unreadable one is an error only if it is selected") {
  std::vector<Cryptomatte> all = named({"CryptoMaterial", "CryptoObject"});
  all[0].fault = "cryptomatte CryptoMaterial: broken";
  CHECK(choose_cryptomatte(all, "CryptoObject", "").name == "CryptoObject");
  CHECK(message_of<DataError>([&] { (void)choose_cryptomatte(all, "CryptoMaterial", ""); }) ==
        "cryptomatte CryptoMaterial: broken");
}

}  // namespace cryptomatte_test
