// The `main` of every Catch2 executable, compiled once and shared by them all (see tests/CMakeLists.txt).
#define CATCH_CONFIG_RUNNER
#include "catch2.h"

int main(int argc, char** argv) { return Catch::Session().run(argc, argv); }
