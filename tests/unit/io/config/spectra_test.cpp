#include "io/config/spectra.h"

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace spectrum_files_test {

using namespace thermal;

namespace {

/// The fault of a response file with this content; "FILE" stands for its name.
std::string fault_in(const std::string& content) {
  const TestFolder folder;
  const Path file = folder.file("response.csv", content);
  std::string message = message_of<ConfigError>([&] { (void)read_response(file); });
  const std::size_t at = message.find(file.string());
  return at == std::string::npos ? message : message.replace(at, file.string().size(), "FILE");
}

}  // namespace

TEST_CASE("A response is read past comments, empty lines and other line endings") {
  const TestFolder folder;
  const SpectralResponse response = read_response(
      folder.file("r.csv", "# a camera\n\nwavelength_um,response\r\n7.5,0.25\r\n# kink\n10,1\n13.5,0.5"));
  REQUIRE(response.samples().size() == 3);
  CHECK(response.begin_um() == 7.5);
  CHECK(response.end_um() == 13.5);
  CHECK(response.samples()[0].response == 0.25);
}

TEST_CASE("A response saved by Excel, with a byte-order mark and CRLF, reads as one without") {
  const TestFolder folder;
  const SpectralResponse plain = read_response(folder.file("a.csv", "wavelength_um,response\n8,1\n14,0.5\n"));
  CHECK(read_response(folder.file("b.csv", "\xEF\xBB\xBFwavelength_um,response\r\n8,1\r\n14,0.5\r\n")) ==
        plain);
}

TEST_CASE("A response without its header is a fault") {
  CHECK(fault_in("7.5,1\n13.5,1\n") == "FILE:1 = \"7.5,1\"; expected the header wavelength_um,response");
  CHECK(fault_in("# c\nwavelength_nm,response\n") ==
        "FILE:2 = \"wavelength_nm,response\"; expected the header wavelength_um,response");
}

TEST_CASE("A line that is not two numbers is an error with its number") {
  const std::string rule = "; expected two numbers: wavelength_um,response";
  const std::string header = "wavelength_um,response\n8,1\n";
  CHECK(fault_in(header + "9;1\n") == "FILE:3 = \"9;1\"" + rule);
  CHECK(fault_in(header + "9\n") == "FILE:3 = \"9\"" + rule);
  CHECK(fault_in(header + "9,\n") == "FILE:3 = \"9,\"" + rule);
  CHECK(fault_in(header + "9,1,2\n") == "FILE:3 = \"9,1,2\"" + rule);
  CHECK(fault_in(header + "nine,1\n") == "FILE:3 = \"nine,1\"" + rule);
}

TEST_CASE("Invalid numbers are reported with the file's name") {
  CHECK(fault_in("wavelength_um,response\n") == "FILE: response: samples = 0; expected at least 2");
  CHECK(fault_in("wavelength_um,response\n9,1\n8,1\n") ==
        "FILE: response: wavelength 2 = 8 um; expected a finite number above 9 um");
}

TEST_CASE("A missing response cannot be read") {
  CHECK(message_of<IoError>([] { (void)read_response("/nowhere/r.csv"); }) ==
        "cannot read /nowhere/r.csv: no such file");
}

}  // namespace spectrum_files_test
