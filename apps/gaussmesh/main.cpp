// The program: options, exit codes, and what is said on the terminal.

#include <iostream>

#include "check_command.h"
#include "convert_command.h"
#include "gaussmesh/error.h"
#include "gaussmesh/version.h"
#include "mesh_command.h"

namespace {

/// Exit codes, by who can mend the error.
enum ExitCode { kGood = 0, kInternal = 1, kWrongUse = 2, kInput = 3, kCannotMesh = 4 };

int fail(const std::exception& error, ExitCode code) {
  std::cerr << "gaussmesh: " << error.what() << "\n";
  return code;
}

int run(int argc, char** argv) {
  CLI::App program(
      "gaussmesh: certified triangular meshes of molecular Gaussian surfaces\n"
      "  { x : sum_i exp(-d (|x - x_i|^2 - r_i^2)) = c }");
  program.set_version_flag("--version", std::string("gaussmesh ") + gaussmesh::kVersion);
  program.footer(
      "Example:  gaussmesh in.pqr --d 0.6 --c 1.7 -o out.off\n\n"
      "Exit codes: 0 good, 1 internal error, 2 wrong use, 3 bad input, 4 cannot mesh, 5 check failed");
  gaussmesh::app::MeshCommand mesh;
  gaussmesh::app::add_mesh_options(program, mesh);
  gaussmesh::app::CheckOptions check;
  CLI::App* check_command = gaussmesh::app::add_check_command(program, check);
  gaussmesh::app::ConvertOptions convert;
  CLI::App* convert_command = gaussmesh::app::add_convert_command(program, convert);
  program.require_subcommand(0, 1);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = program.exit(error);
    return code == 0 ? kGood : kWrongUse;
  }
  if (check_command->parsed()) return gaussmesh::app::run_check(check);
  if (convert_command->parsed()) return gaussmesh::app::run_convert(convert);
  return gaussmesh::app::run_mesh(mesh);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const gaussmesh::OptionError& error) {
    return fail(error, kWrongUse);
  } catch (const gaussmesh::InputError& error) {
    return fail(error, kInput);
  } catch (const gaussmesh::CannotMeshError& error) {
    return fail(error, kCannotMesh);
  } catch (const std::exception& error) {
    return fail(error, kInternal);
  }
}
