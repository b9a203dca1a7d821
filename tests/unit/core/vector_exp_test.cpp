#include "core/vector_exp.h"

#include <cmath>

#include "catch2.h"
#include "support/random.h"

using namespace gaussmesh;
using testing::Random;

namespace {

double relative_error(double x) {
  const long double exact = std::exp(static_cast<long double>(x));
  return static_cast<double>(std::abs(static_cast<long double>(vector_exp(x)) / exact - 1.0L));
}

}  // namespace

TEST_CASE("vector_exp keeps the error that the bounds rely on") {
  double largest = 0.0;
  SECTION("over the whole range") {
    const std::uint64_t seed = 2;
    CAPTURE(seed);
    Random random(seed);
    for (int i = 0; i < 1000000; ++i) largest = std::max(largest, relative_error(random.uniform(-700.0, 700.0)));
  }
  SECTION("where the argument reduction changes over: odd multiples of ln(2) / 2") {
    for (int n = -2019; n <= 2019; n += 2) {
      const double at = 0.5 * n * std::log(2.0);
      for (const double x : {std::nextafter(at, -1e9), at, std::nextafter(at, 1e9)}) {
        largest = std::max(largest, relative_error(x));
      }
    }
  }
  SECTION("near zero and at the ends") {
    for (double x = 1.0; x > 1e-300; x *= 0.1) {
      largest = std::max({largest, relative_error(x), relative_error(-x)});
    }
    largest = std::max({largest, relative_error(700.0), relative_error(-700.0)});
  }
  CHECK(largest <= kVectorExpError);
  CHECK(largest > 0.0);
}

TEST_CASE("vector_exp(0) is 1") {
  CHECK(vector_exp(0.0) == 1.0);
  CHECK(vector_exp(-0.0) == 1.0);
}

TEST_CASE("vector_exp is clamped, and so is always a positive finite number") {
  for (const double x : {700.0, 701.0, 1e6, 1e300, std::numeric_limits<double>::infinity()}) {
    CHECK(vector_exp(x) == vector_exp(700.0));
    CHECK(vector_exp(-x) == vector_exp(-700.0));
  }
}

TEST_CASE("exp_above is nowhere below exp, and 6.2 % above it at most") {
  const std::uint64_t seed = 3;
  CAPTURE(seed);
  Random random(seed);
  long double least = 2.0L, largest = 0.0L;
  const auto look_at = [&](double x) {
    const long double ratio = static_cast<long double>(exp_above(x)) / std::exp(static_cast<long double>(x));
    least = std::min(least, ratio);
    largest = std::max(largest, ratio);
  };
  for (int i = 0; i < 1000000; ++i) look_at(random.uniform(-700.0, 700.0));
  for (int n = -1009; n <= 1009; ++n) {  // where the chords meet
    const double at = n * std::log(2.0);
    for (const double x : {std::nextafter(at, -1e9), at, std::nextafter(at, 1e9)}) look_at(x);
  }
  for (const double x : {-700.0, -0.0, 0.0, 1e-300, -1e-300, 700.0}) look_at(x);
  CHECK(least >= 1.0L);
  CHECK(largest <= 1.062L);
  CHECK(largest > 1.06L);
}

TEST_CASE("vector_log keeps its error over all normal numbers, and where the exponent changes over") {
  const std::uint64_t seed = 4;
  CAPTURE(seed);
  Random random(seed);
  double largest = 0.0;
  const auto look_at = [&](double x) {
    const long double exact = std::log(static_cast<long double>(x));
    largest = std::max(largest, static_cast<double>(std::abs(static_cast<long double>(vector_log(x)) - exact)));
  };
  for (int i = 0; i < 1000000; ++i) look_at(std::exp(random.uniform(-708.0, 709.0)));
  for (int i = 0; i < 100000; ++i) look_at(random.uniform(0.5, 2.0));
  for (int n = -1021; n <= 1023; ++n) {
    for (const double mantissa : {1.0, std::sqrt(0.5), std::sqrt(2.0)}) {
      const double at = std::ldexp(mantissa, n);
      for (const double x : {std::nextafter(at, 0.0), at, std::nextafter(at, 1e308)}) {
        if (std::isnormal(x)) look_at(x);
      }
    }
  }
  CHECK(largest <= kVectorLogError);
  CHECK(largest > 0.0);
  CHECK(vector_log(1.0) == 0.0);
}

TEST_CASE("vector_log of four numbers is that of each") {
  const Quad x = {0.3, 1.0, 2.5e-300, 7.0e300};
  const Quad logs = vector_log(x);
  for (int lane = 0; lane < kQuadLanes; ++lane) CHECK(logs[lane] == Approx(vector_log(x[lane])).epsilon(1e-15));
}

TEST_CASE("in single precision it is good to 3e-7, and clamped") {
  const std::uint64_t seed = 3;
  CAPTURE(seed);
  Random random(seed);
  double largest = 0.0;
  for (int i = 0; i < 1000000; ++i) {
    const auto x = static_cast<float>(random.uniform(-80.0, 80.0));
    largest = std::max(largest, std::abs(double(vector_exp(x)) / std::exp(double(x)) - 1.0));
  }
  CHECK(largest <= 3e-7);
  CHECK(vector_exp(0.0f) == 1.0f);
  CHECK(vector_exp(-1e30f) == vector_exp(-80.0f));
  CHECK(vector_exp(1e30f) == vector_exp(80.0f));
}
