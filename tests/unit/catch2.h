// Catch2 for every test: one include for Catch2 2.13 (Debian 12) and Catch2 3.
//
// Where the two differ, tests write what version 3 calls it; the shims below give it to version 2:
// `Catch::Matchers::ContainsSubstring`, and `Approx` without its namespace.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)

#include <catch2/catch_all.hpp>

using Catch::Approx;

#else

#include <catch2/catch.hpp>
#include <string>

namespace Catch::Matchers {

inline auto ContainsSubstring(const std::string& text, CaseSensitive::Choice sensitivity = CaseSensitive::Yes) {
  return Contains(text, sensitivity);
}

}  // namespace Catch::Matchers

#endif
