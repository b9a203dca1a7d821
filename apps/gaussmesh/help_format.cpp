#include "help_format.h"

#include <algorithm>
#include <sstream>

namespace gaussmesh::app {
namespace {

constexpr std::size_t kNameWidth = 26;
constexpr std::size_t kWidth = 100;

/// `text` broken into lines of up to kWidth characters, each behind kNameWidth blanks but the first.
std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string lines;
  std::size_t column = kNameWidth;
  for (std::string word; words >> word; column += word.size()) {
    if (!lines.empty() && column + 1 + word.size() > kWidth) {
      lines += "\n" + std::string(kNameWidth, ' ');
      column = kNameWidth;
    } else if (!lines.empty()) {
      lines += ' ';
      ++column;
    }
    lines += word;
  }
  return lines + "\n";
}

/// `names` on the left, or above where they are too long.
std::string entry(const std::string& names, const std::string& text) {
  const std::string left = "  " + names;
  const bool fits = left.size() + 2 <= kNameWidth;
  return left + (fits ? std::string(kNameWidth - left.size(), ' ') : "\n" + std::string(kNameWidth, ' ')) +
         wrapped(text);
}

}  // namespace

std::string help_text(const CLI::App& app) {
  std::string text = app.get_description() + "\n\nUsage:\n";
  for (const std::string& usage : usage_lines(app)) text += "  " + usage + "\n";
  for (const OptionGroup& group : option_groups(app)) {
    text += "\n" + group.name + ":\n";
    for (const CLI::Option* option : group.options) text += entry(names_and_value(*option), option->get_description());
  }
  const auto commands = subcommands(app);
  if (!commands.empty()) text += "\nCommands:\n";
  for (const CLI::App* command : commands) text += entry(command->get_name(), command->get_description());
  return text + "\n" + app.get_footer() + "\n";
}

std::vector<const CLI::App*> subcommands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<OptionGroup> option_groups(const CLI::App& app) {
  std::vector<OptionGroup> groups{{"Arguments", {}}};
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_positional() ? groups.front().name : option->get_group();
    if (name.empty()) continue;
    auto group = std::find_if(groups.begin(), groups.end(), [&](const OptionGroup& g) { return g.name == name; });
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    group->options.push_back(option);
  }
  return groups;
}

std::vector<std::string> dashed_names(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string value_name(const CLI::Option& option) {
  return option.get_type_size() == 0 ? std::string() : option.get_type_name();
}

std::string names_and_value(const CLI::Option& option) {
  std::string text;
  for (const std::string& name : dashed_names(option)) text += (text.empty() ? "" : ", ") + name;
  const std::string value = value_name(option);
  return text + (text.empty() || value.empty() ? "" : " ") + value;
}

std::vector<std::string> usage_lines(const CLI::App& app) {
  if (app.get_parent() == nullptr) return {"gaussmesh [OPTIONS] MOL -o FILE", "gaussmesh COMMAND [OPTIONS] ..."};
  std::string line = app.get_parent()->get_name() + " " + app.get_name() + " [OPTIONS]";
  const std::vector<OptionGroup> groups = option_groups(app);
  for (const CLI::Option* option : groups.front().options) {
    const std::string name = value_name(*option);
    line += option->get_required() ? " " + name : " [" + name + "]";
  }
  return {line};
}

}  // namespace gaussmesh::app
