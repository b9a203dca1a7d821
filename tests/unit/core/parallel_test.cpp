#include "core/parallel.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "catch2.h"

using namespace gaussmesh;

TEST_CASE("parallel_for calls every index once, whatever the number of threads") {
  for (const int threads : {1, 2, 5}) {
    for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
      std::vector<int> calls(count, 0);
      parallel_for(count, threads, [&](std::size_t i) { ++calls[i]; });
      CHECK(calls == std::vector<int>(count, 1));
    }
  }
}

TEST_CASE("parallel_for throws the exception of the smallest index") {
  for (const int threads : {1, 2, 5}) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::string caught;
      try {
        parallel_for(500, threads, [](std::size_t i) {
          if (i % 100 == 37) throw std::runtime_error(std::to_string(i));
        });
      } catch (const std::runtime_error& error) {
        caught = error.what();
      }
      CHECK(caught == "37");
    }
  }
}

TEST_CASE("parallel_for keeps the type of what was thrown") {
  struct Own {
    int value;
  };
  try {
    parallel_for(10, 2, [](std::size_t i) {
      if (i == 3) throw Own{33};
      if (i == 8) throw std::runtime_error("later");
    });
    FAIL("nothing was thrown");
  } catch (const Own& own) {
    CHECK(own.value == 33);
  }
}

TEST_CASE("what is gathered in parts comes in the order of the parts, whatever the number of threads") {
  for (const int threads : {1, 2, 5}) {
    for (const std::size_t count : {0u, 1u, 7u, 8u, 1000u}) {
      std::vector<std::size_t> expected;
      for (std::size_t i = 0; i < count; ++i) expected.insert(expected.end(), i % 3, i);
      const auto gathered = parallel_gather<std::size_t>(
          count, 8, threads, [](std::size_t first, std::size_t last, std::vector<std::size_t>& list) {
            for (std::size_t i = first; i < last; ++i) list.insert(list.end(), i % 3, i);
          });
      CHECK(gathered == expected);
    }
  }
}

TEST_CASE("an array that grows on all threads keeps what it has, and the rest is zero") {
  for (const int threads : {1, 2, 5}) {
    for (const std::size_t count : {0u, 3u, 1000u, 200000u}) {
      std::vector<int> array{1, 2, 3, 4, 5};
      resize_in_parallel(array, count, threads);
      std::vector<int> expected{1, 2, 3, 4, 5};
      expected.resize(count);
      CHECK(array == expected);
    }
  }
}
