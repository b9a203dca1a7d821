#include "config_file.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>
#include <string_view>

#include "gaussmesh/error.h"
#include "gaussmesh/nearest_name.h"

namespace gaussmesh::app {
namespace {

/// A line of the file, for messages.
struct Line {
  std::size_t number = 0;  ///< from 1; 0: not found
  std::string text;
};

/// Whether the line, without blanks in front, is that of the key: `key = ...`, or `key` alone.
bool has_key(std::string_view line, std::string_view key) {
  if (line.starts_with('"') || line.starts_with('\'')) line.remove_prefix(1);
  if (!line.starts_with(key)) return false;
  line.remove_prefix(key.size());
  return line.empty() || std::string_view(" \t\"'=#").find(line.front()) != std::string_view::npos;
}

/// The first line behind number `after` that begins with `[`, for an empty key, or has the key. CLI11 does not tell
/// where it found one.
Line find_line(const std::string& text, const std::string& key, std::size_t after) {
  std::istringstream lines(text);
  Line line;
  for (std::string raw; std::getline(lines, raw);) {
    ++line.number;
    line.text = CLI::detail::trim_copy(raw);
    const bool is_found = key.empty() ? line.text.starts_with('[') : has_key(line.text, key);
    if (line.number > after && is_found) return line;
  }
  return {};
}

/// Whether one of the options that exclude this one is on the command line.
bool is_excluded(const CLI::Option& option) {
  const auto others = option.get_excludes();
  return std::any_of(others.begin(), others.end(), [](const CLI::Option* other) { return other->count() > 0; });
}

/// Whether the item is a flag that is not raised, which is as if it were not there.
bool is_off(const CLI::ConfigItem& item, const CLI::Option& option) {
  return option.get_expected_max() == 0 && item.inputs == std::vector<std::string>{"false"};
}

/// Whether `word` is in the text and is not a part of a longer name.
bool has_word(const std::string& text, const std::string& word) {
  const auto is_part = [](char c) { return c == '-' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !is_part(text[at - 1])) && (end == text.size() || !is_part(text[end]))) return true;
  }
  return false;
}

/// The option that a key names, if it may be in a file.
const CLI::Option* find_option(const CLI::App& program, const std::string& key) {
  const CLI::Option* option = nullptr;
  for (const char* dashes : {"--", "-", ""}) {
    if (option == nullptr) option = program.get_option_no_throw(dashes + key);
  }
  return option != nullptr && option->get_configurable() && !option->get_group().empty() ? option : nullptr;
}

std::vector<std::string> keys(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::Option* option : program.get_options()) {
    if (!option->get_configurable() || option->get_group().empty()) continue;
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  }
  return names;
}

}  // namespace

std::vector<CLI::ConfigItem> ConfigFile::from_config(std::istream& input) const {
  std::string text{std::istreambuf_iterator<char>(input), {}};
  if (constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF"; text.starts_with(kByteOrderMark))
    text.erase(0, kByteOrderMark.size());  // which editors of Windows put there
  const auto name = program_.get_config_ptr()->as<std::string>();
  const auto place = [&](const Line& line) {
    return name + ":" + (line.number > 0 ? std::to_string(line.number) + ":" : "") + " ";
  };
  std::istringstream copy(text);
  std::vector<CLI::ConfigItem> counting;
  for (const CLI::ConfigItem& item : CLI::ConfigTOML::from_config(copy)) {
    const bool is_section = item.name == "++";
    const Line line = find_line(text, is_section ? "" : item.fullname(), 0);
    if (is_section) throw OptionError(place(line) + "expected options without sections, got '" + line.text + "'");
    const CLI::Option* const option = item.parents.empty() ? find_option(program_, item.name) : nullptr;
    if (option == nullptr) {
      throw OptionError(place(line) + "expected an option of gaussmesh, got '" + item.fullname() + "'" +
                        did_you_mean(item.name, keys(program_)));
    }
    const auto is_this = [&](const Given& given) { return given.option == option; };
    if (std::any_of(given_.begin(), given_.end(), is_this)) {
      const Line again = find_line(text, item.name, line.number);
      throw OptionError(place(again.number > 0 ? again : line) + "expected each option once, got '" + item.name +
                        "' again");
    }
    if (option->count() > 0 || is_excluded(*option) || is_off(item, *option)) continue;
    given_.push_back({option, place(line)});
    counting.push_back(item);
  }
  return counting;
}

std::string ConfigFile::place_of(const std::string& message) const {
  for (const Given& given : given_) {
    if (has_word(message, given.option->get_name())) return given.place;
  }
  return "";
}

}  // namespace gaussmesh::app
