#include "parse_errors.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "config_file.h"
#include "gaussmesh/error.h"
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

/// What there is to say where the first word is no file, but nearly a command; else nothing.
std::string mistyped_command(const CLI::App& program) {
  constexpr std::size_t kMostEdits = 2;
  const std::vector<std::string> words = program.get_option("molecule")->results();
  std::error_code error;  // of names that are too long
  if (&called(program) != &program || words.empty() || std::filesystem::exists(words.front(), error)) return "";
  std::vector<std::string> commands;
  for (const CLI::App* command : subcommands(program)) commands.push_back(command->get_name());
  const std::string& word = words.front();
  const std::string nearest = nearest_name(word, commands);
  if (!is_beginning(word, nearest) && edit_distance(lower_case(word), nearest) > kMostEdits) return "";
  return "expected a file of atoms or a command, got '" + word + "'; did you mean '" + nearest + "'?";
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

/// Whether the word is written as an option is.
bool has_dash(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

/// More names of files than there is use for; a `--` among them is where options end.
std::string too_many_words(const CLI::App& program, std::vector<std::string> extras) {
  const auto mark = std::find(extras.begin(), extras.end(), "--");
  std::string end;
  if (mark != extras.end()) {
    if (std::any_of(mark + 1, extras.end(), has_dash)) end = "; nothing behind -- is an option";
    extras.erase(mark);
  }
  const std::string got = join_names(quoted(extras), ", ") + end;
  if (&called(program) != &program) return called(program).get_name() + ": expected no further file, got " + got;
  const std::vector<std::string> molecule = program.get_option("molecule")->results();
  return "expected one molecule, got " + join_names(quoted(molecule), ", ") + " and " + got;
}

/// The option that CLI11's message is about, which begins with its name or has it last; nothing if there is none.
const CLI::Option* option_of(const CLI::App& program, const std::string& message) {
  const std::size_t end = message.find_first_of(": ");
  for (const CLI::Option* option : called(program).get_options()) {
    const std::string name = option->get_name();
    if (message.substr(0, end) == name || message.find(": " + name + " = ") != std::string::npos) return option;
  }
  return nullptr;
}

/// What a command needs and what it got, such as `compare: expected A B, got 'a.off'`.
std::string missing_words(const CLI::App& command) {
  std::vector<std::string> wanted, got;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional() || !option->get_required()) continue;
    wanted.push_back(value_name(*option));
    for (const std::string& word : option->results()) got.push_back(word);
  }
  return command.get_name() + ": expected " + join_names(wanted, " ") + ", got " +
         (got.empty() ? "nothing" : join_names(quoted(got), ", "));
}

/// CLI11's message `NAME requires OTHER` or `NAME excludes OTHER` in other words; empty if the error is neither.
std::string about_two(const CLI::App& program, const CLI::ParseError& error) {
  const bool is_lacking = dynamic_cast<const CLI::RequiresError*>(&error) != nullptr;
  if (!is_lacking && dynamic_cast<const CLI::ExcludesError*>(&error) == nullptr) return "";
  const std::string message = error.what();
  const std::string name = message.substr(0, message.find(' '));
  const std::string other = message.substr(message.rfind(' ') + 1);
  const CLI::Option* const option = called(program).get_option_no_throw(other);
  const std::string shown = option != nullptr && option->get_positional() ? value_name(*option) : other;
  return is_lacking ? name + ": expected " + shown + " too, got none"
                    : "expected " + name + " or " + shown + ", got both";
}

/// What CLI11 says, in the program's words where it is known what that is about.
std::string in_own_words(const CLI::App& program, const CLI::ParseError& error) {
  const std::string message = error.what();
  const std::string two = about_two(program, error);
  if (!two.empty()) return two;
  if (dynamic_cast<const CLI::FileError*>(&error) != nullptr)
    return program.get_config_ptr()->as<std::string>() + ": expected a readable file of options, got none";
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) return missing_words(called(program));
  const CLI::Option* const option = option_of(program, message);
  if (option == nullptr) return message;
  const std::vector<std::string> got = quoted(option->results());
  const std::string where = option->get_name() + ": expected ";
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    return got.size() > 1 ? where + "once, got " + std::to_string(got.size()) + " values: " + join_names(got, ", ")
                          : where + value_name(*option) + " behind it, got nothing";
  }
  const bool is_flag = option->get_expected_max() == 0;
  if (is_flag && dynamic_cast<const CLI::ConversionError*>(&error) != nullptr)
    return where + "true or false, got " + join_names(got, ", ");
  return message;
}

}  // namespace

std::string message_of(const CLI::App& program, const CLI::ParseError& error) {
  const std::string command = mistyped_command(program);  // whose options are not those of meshing
  if (!command.empty()) return command;
  const std::vector<std::string> extras = program.remaining(true);
  const auto end = std::find(extras.begin(), extras.end(), "--");
  const auto option = std::find_if(extras.begin(), end, has_dash);
  if (option != end) return unknown_option(program, *option);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) return too_many_words(program, extras);
  const auto config = std::dynamic_pointer_cast<const ConfigFile>(program.get_config_formatter());
  return (config ? config->place_of(error.what()) : "") + in_own_words(program, error);
}

void require_known_command(const CLI::App& program) {
  const std::string command = mistyped_command(program);
  if (!command.empty()) throw OptionError(command);
}

void require_command_alone(const CLI::App& program) {
  const CLI::App& command = called(program);
  if (&command == &program) return;
  for (const CLI::Option* option : program.get_options()) {
    if (option->count() == 0) continue;
    const std::string got = option->get_positional() ? option->results().front() : option->get_name();
    throw OptionError("expected '" + command.get_name() + "' as the first word, got '" + got + "' before it");
  }
}

}  // namespace gaussmesh::app
