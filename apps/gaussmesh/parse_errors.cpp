#include "parse_errors.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "config_file.h"
#include "gaussmesh/nearest_name.h"
#include "help_format.h"
#include "validators.h"

namespace gaussmesh::app {
namespace {

/// The sub-command that was called, else the program.
const CLI::App& called(const CLI::App& program) {
  const auto commands = program.get_subcommands();
  return commands.empty() ? program : *commands.front();
}

std::vector<std::string> quoted(std::vector<std::string> words) {
  for (std::string& word : words) word = "'" + word + "'";
  return words;
}

/// An option that there is not. Its value, if it has one, is left aside.
std::string unknown_option(const CLI::App& program, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::Option* option : called(program).get_options()) {
    if (option->get_group().empty()) continue;
    for (const std::string& name : dashed_names(*option)) names.push_back(name);
  }
  const std::string command = &called(program) == &program ? "" : " " + called(program).get_name();
  const std::string name = word.substr(0, word.find('='));
  const bool is_letter = name.size() == 2;  // to which any other is near
  return "expected an option of gaussmesh" + command + ", got '" + name + "'" +
         (is_letter ? "" : did_you_mean(name, names));
}

/// More names of files than there is use for. The first may be a sub-command that was not written well.
std::string too_many_words(const CLI::App& program, const std::vector<std::string>& extras) {
  const std::string got = join_names(quoted(extras), ", ");
  if (&called(program) != &program)
    return "gaussmesh " + called(program).get_name() + ": expected no further file, got " + got;
  const std::vector<std::string> molecule = program.get_option("molecule")->results();
  std::vector<std::string> commands;
  for (const CLI::App* command : subcommands(program)) commands.push_back(command->get_name());
  return "expected one molecule, got " + join_names(quoted(molecule), ", ") + " and " + got +
         (molecule.empty() ? "" : did_you_mean(molecule.front(), commands));
}

/// The option of which there are more values than it takes, if that is the error.
const CLI::Option* repeated(const CLI::App& program, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) == nullptr) return nullptr;
  const std::string what = error.what();
  for (const CLI::Option* option : called(program).get_options()) {
    if (option->count() > 1 && what.starts_with(option->get_name() + ": ")) return option;
  }
  return nullptr;
}

}  // namespace

std::string message_of(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<std::string> extras = program.remaining(true);
  const auto option = std::find_if(extras.begin(), extras.end(),
                                   [](const std::string& word) { return word.size() > 1 && word[0] == '-'; });
  if (option != extras.end()) return unknown_option(program, *option);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) return too_many_words(program, extras);
  const auto config = std::dynamic_pointer_cast<const ConfigFile>(program.get_config_formatter());
  const std::string place = config ? config->place_of(error.what()) : "";
  if (const CLI::Option* const twice = repeated(program, error)) {
    return place + twice->get_name() + ": expected once, got " + std::to_string(twice->count()) +
           " values: " + join_names(quoted(twice->results()), ", ");
  }
  return place + error.what();
}

}  // namespace gaussmesh::app
