#include "verify/parallel.h"

#include <stdexcept>
#include <string>

#include "catch2.h"
#include "support/threads.h"

using namespace gaussmesh;

TEST_CASE("the judge's loops throw the exception of the smallest index, whatever the number of threads") {
  for (const int threads : {1, 2, 5}) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      const std::string caught = testing::on_threads(threads, [] {
        try {
          verify::parallel_for(500, [](std::size_t i) {
            if (i % 100 == 37) throw std::runtime_error(std::to_string(i));
          });
        } catch (const std::runtime_error& error) {
          return std::string(error.what());
        }
        return std::string();
      });
      CHECK(caught == "37");
    }
  }
}
