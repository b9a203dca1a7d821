// The program: options, exit codes, and what is said on the terminal.

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>

#include "check_command.h"
#include "compare_command.h"
#include "config_file.h"
#include "convert_command.h"
#include "exit_code.h"
#include "gaussmesh/error.h"
#include "gaussmesh/version.h"
#include "help_format.h"
#include "manual.h"
#include "measure_command.h"
#include "memory_limit.h"
#include "mesh_command.h"
#include "parse_errors.h"
#include "validators.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

using namespace gaussmesh::app;

constexpr const char* kFooter =
    "Examples:\n"
    "  gaussmesh in.pqr --d 0.6 --c 1.7 -o out.off      a surface of the volume of the solvent-excluded one\n"
    "  gaussmesh in.pqr --preset sas -o out.vert        solvent-accessible, as out.vert and out.face of MSMS\n"
    "  gaussmesh in.pqr -o out.off -o out.vtp           one surface in two formats\n"
    "  gaussmesh in.pqr --cavities drop -o out.smesh    without cavities, for TetGen\n"
    "  zcat in.pqr.gz | gaussmesh - -o - | less         from standard input to standard output\n"
    "  gaussmesh check out.off in.pqr --d 0.6 --c 1.7   judge a mesh\n\n"
    "Exit codes: 0 good, 1 internal error, 2 wrong use, 3 bad input, 4 cannot mesh, 5 check failed";

int fail(const std::exception& error, ExitCode code) {
  std::cerr << "gaussmesh: " << error.what() << "\n";
  return code;
}

/// The signal that came while files were put in their places; 0: none.
volatile std::sig_atomic_t late_signal = 0;

/// Ends the program as the signal would have.
void die_of(int signal) {
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Leaves no temporary file behind, and no set of files that are half new and half old.
void clean_up_and_die(int signal) {
  if (gaussmesh::remove_unfinished_files()) {
    die_of(signal);
  } else {
    late_signal = signal;
  }
}

/// Gives standard streams that are closed an end that takes nothing, so that writing to them fails: the next file that
/// is opened would have their number, and get what they are meant for.
void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

void handle_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXCPU}) {
    // What the caller has told us to ignore, as nohup does, stays ignored.
    if (std::signal(signal, clean_up_and_die) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  std::signal(SIGXFSZ, SIG_IGN);  // a file that is too large is then an error of write()
}

/// Lets threads sleep while they wait for others. Left to itself libgomp lets them spin, and where other programs run
/// too, they keep the processor from the thread that they wait for: beside one other busy program on two processors a
/// small protein took 5 to 7 times as long. The environment is read once, before main(): so the program begins anew,
/// by the name of its file, which is what ps and top show.
void let_waiting_threads_sleep(char** argv) {
#ifdef __linux__
  if (::getenv("OMP_WAIT_POLICY") != nullptr || ::getenv("GOMP_SPINCOUNT") != nullptr) return;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  // Where the loader was told to run this, it would take other words.
  if (error || program.filename().string().starts_with("ld-")) return;
  if (::setenv("OMP_WAIT_POLICY", "passive", 1) != 0) return;
  ::execv(program.c_str(), argv);
  ::execv("/proc/self/exe", argv);  // the file has gone meanwhile; where this fails too, they spin
#else
  static_cast<void>(argv);
#endif
}

/// Large arrays are given back to the system as soon as they are free. Left to itself, glibc keeps arrays of the size
/// of those that were freed before, whose room the smaller ones that follow then break up.
void keep_large_arrays_apart() {
#ifdef __GLIBC__
  constexpr int kLargeArray = 1 << 20;  // bytes
  mallopt(M_MMAP_THRESHOLD, kLargeArray);
#endif
}

/// Prints the page or script; the names are those of --print-manual.
int print_manual(const CLI::App& program, const std::string& kind) {
  std::cout << (kind == "man"    ? manual_page(program)
                : kind == "bash" ? bash_completion(program)
                                 : zsh_completion(program));
  return kGood;
}

int run(int argc, char** argv) {
  CLI::App program(
      "gaussmesh: certified triangular meshes of molecular Gaussian surfaces\n"
      "  { x : sum_i exp(-d (|x - x_i|^2 - r_i^2)) = c }",
      "gaussmesh");
  program.footer(kFooter);
  program.formatter_fn([](const CLI::App* app, const std::string&, CLI::AppFormatMode) { return help_text(*app); });
  std::string manual;
  program.add_option("--print-manual", manual, "man, bash or zsh")->check(one_of({"man", "bash", "zsh"}))->group("");
  MeshCommand mesh;
  add_mesh_options(program, mesh);
  program.set_help_flag("-h,--help", "print this and exit")->group("Running");
  program.set_version_flag("--version", std::string("gaussmesh ") + gaussmesh::kVersion, "print the version and exit")
      ->group("Running");
  CLI::Option* const config =
      program
          .set_config("--config", "",
                      "read options from a TOML file; those on the command line come first (default: none)")
          ->type_name("FILE")
          ->check(file_name_of_option())
          ->group("Running");
  program.config_formatter(std::make_shared<ConfigFile>(program));
  CheckCommand check;
  CLI::App* check_command = add_check_command(program, check);
  ConvertCommand convert;
  CLI::App* convert_command = add_convert_command(program, convert);
  MeasureCommand measure;
  CLI::App* measure_command = add_measure_command(program, measure);
  CompareCommand compare;
  CLI::App* compare_command = add_compare_command(program, compare);
  program.require_subcommand(0, 1);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& success) {  // help and version
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    std::cerr << "gaussmesh: " << message_of(program, error) << "\nRun with --help for more information.\n";
    return dynamic_cast<const CLI::FileError*>(&error) != nullptr ? kInput : kWrongUse;
  }
  require_known_command(program);
  require_command_alone(program);
  if (config->count() > 0) mesh.config = config->as<std::string>();
  if (!manual.empty()) return print_manual(program, manual);
  if (check_command->parsed()) return run_check(check);
  if (convert_command->parsed()) return run_convert(convert);
  if (measure_command->parsed()) return run_measure(measure);
  if (compare_command->parsed()) return run_compare(compare);
  return run_mesh(mesh);
}

/// run(), with its errors told.
int run_and_tell(int argc, char** argv) {
  try {
    const int code = run(argc, argv);
    if (!std::cout.flush()) throw gaussmesh::InputError("standard output: cannot be written to");
    return code;
  } catch (const gaussmesh::OptionError& error) {
    return fail(error, kWrongUse);
  } catch (const gaussmesh::InputError& error) {
    return fail(error, kInput);
  } catch (const gaussmesh::CannotMeshError& error) {
    return fail(error, kCannotMesh);
  } catch (const NoRoomOnDisk& error) {
    return fail(error, kCannotMesh);
  } catch (const std::bad_alloc&) {
    std::cerr << "gaussmesh: not enough memory; choose a larger --spacing, or set --max-memory\n";
    return kCannotMesh;
  } catch (const std::exception& error) {
    return fail(error, kInternal);
  }
}

}  // namespace

int main(int argc, char** argv) {
  occupy_standard_streams();
  let_waiting_threads_sleep(argv);
  keep_large_arrays_apart();
  handle_signals();
  const int code = run_and_tell(argc, argv);
  if (late_signal != 0) die_of(late_signal);
  return code;
}
