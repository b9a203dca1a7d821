#include "write/put_number.h"

#include <cfloat>
#include <charconv>
#include <string>

#include "catch2.h"
#include "support/random.h"

using namespace gaussmesh;

namespace {

std::string coordinate(double value) {
  char text[kLongestNumber];
  return {text, put_coordinate(text, value)};
}

double number(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

TEST_CASE("whole units have nine decimals") {
  CHECK(coordinate(0.0) == "0.000000000");
  CHECK(coordinate(-0.0) == "0.000000000");
  CHECK(coordinate(-1e-9) == "-0.000000001");
  CHECK(coordinate(0.1) == "0.100000000");
  CHECK(coordinate(-1000000.123456789) == "-1000000.123456789");
  CHECK(coordinate(1999999.999999999) == "1999999.999999999");
}

TEST_CASE("what nine decimals do not hold is written in full") {
  for (const double value : {1.0 / 3.0, 1e-10, -1e300, DBL_MAX, -DBL_MIN, DBL_TRUE_MIN, 2e6, 1e9, 1e-9 * 1.5}) {
    CAPTURE(value);
    CHECK(number(coordinate(value)) == value);
  }
}

TEST_CASE("any coordinate comes back as the same double") {
  const std::uint64_t seed = 7;
  CAPTURE(seed);
  testing::Random random(seed);
  for (int i = 0; i < 100000; ++i) {
    const auto units =
        static_cast<double>(random.integer(-1000000000000000, 1000000000000000) >> random.integer(0, 50));
    const double whole = units / 1e9;
    const std::string text = coordinate(whole);
    REQUIRE(number(text) == whole);
    REQUIRE(text.size() - text.find('.') == 10);
    const double other = static_cast<float>(whole);
    REQUIRE(number(coordinate(other)) == other);
  }
}
