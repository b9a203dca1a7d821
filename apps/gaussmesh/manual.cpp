#include "manual.h"

#include <map>
#include <sstream>
#include <vector>

#include "gaussmesh/read_atoms.h"
#include "gaussmesh/version.h"
#include "gaussmesh/write_mesh.h"
#include "help_format.h"
#include "mesh_command.h"
#include "surface_options.h"
#include "validators.h"

namespace gaussmesh::app {
namespace {

/// With what man(7) and shells take for a command made harmless.
std::string escaped(const std::string& text, const std::string& special) {
  std::string result;
  for (const char c : text) {
    if (special.find(c) != std::string::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string roff(const std::string& text) { return escaped(text, "\\-"); }

/// Each group under its name, as help has them.
void add_options(const CLI::App& app, std::ostream& out) {
  for (const OptionGroup& group : option_groups(app)) {
    out << ".SS " << group.name << "\n";
    for (const CLI::Option* option : group.options) {
      std::string names;
      for (const std::string& name : dashed_names(*option)) names += (names.empty() ? "" : ", ") + name;
      const std::string value = value_name(*option);
      out << ".TP\n";
      if (!names.empty()) out << "\\fB" << roff(names) << "\\fR" << (value.empty() ? "" : " ");
      if (!value.empty()) out << "\\fI" << roff(value) << "\\fR";
      out << "\n" << roff(option->get_description()) << "\n";
    }
  }
}

/// The names that the option takes; none where it takes something else.
std::vector<std::string> choices_of(const CLI::Option& option) {
  if (option.check_lname("preset")) return preset_names();
  if (option.check_lname("radii")) return radius_set_names();
  if (option.check_lname("input-format")) return atom_formats();
  if (option.check_lname("cavities")) return cavity_choices();
  std::vector<std::string> names;
  if (option.check_lname("format"))
    for (const MeshFormat& format : mesh_formats()) names.emplace_back(format.name);
  return names;
}

/// All options that help shows, with dashes.
std::vector<const CLI::Option*> dashed_options(const CLI::App& app) {
  std::vector<const CLI::Option*> options;
  for (const OptionGroup& group : option_groups(app))
    for (const CLI::Option* option : group.options)
      if (!option->get_positional()) options.push_back(option);
  return options;
}

/// All options of the program or a sub-command, with blanks between them.
std::string option_words(const CLI::App& app) {
  std::string words;
  for (const CLI::Option* option : dashed_options(app))
    for (const std::string& name : dashed_names(*option)) words += (words.empty() ? "" : " ") + name;
  return words;
}

std::string subcommand_words(const CLI::App& program) {
  std::string words;
  for (const CLI::App* command : subcommands(program)) words += (words.empty() ? "" : " ") + command->get_name();
  return words;
}

}  // namespace

std::string manual_page(const CLI::App& program) {
  std::ostringstream out;
  out << ".TH GAUSSMESH 1 \"\" \"gaussmesh " << kVersion << "\" \"User Commands\"\n.SH NAME\n"
      << "gaussmesh \\- certified triangular meshes of molecular Gaussian surfaces\n.SH SYNOPSIS\n"
      << ".nf\n";
  for (const std::string& usage : usage_lines(program)) out << roff(usage) << "\n";
  out << ".fi\n"
      << ".SH DESCRIPTION\n.nf\n"
      << roff(program.get_description()) << "\n.fi\n.SH OPTIONS\n";
  add_options(program, out);
  for (const CLI::App* command : subcommands(program)) {
    out << ".SH GAUSSMESH " << command->get_name() << "\n" << roff(command->get_description()) << "\n";
    add_options(*command, out);
    out << ".PP\n.nf\n" << roff(command->get_footer()) << "\n.fi\n";
  }
  out << ".SH EXAMPLES AND EXIT CODES\n.nf\n" << roff(program.get_footer()) << "\n.fi\n";
  return out.str();
}

std::string bash_completion(const CLI::App& program) {
  std::map<std::string, std::string> choices;  // behind an option; none: a file, or a number
  const auto add_choices = [&](const CLI::App& app) {
    for (const CLI::Option* option : dashed_options(app))
      for (const std::string& name : dashed_names(*option))
        if (!value_name(*option).empty()) choices[name] = join_names(choices_of(*option), " ");
  };
  add_choices(program);
  for (const CLI::App* command : subcommands(program)) add_choices(*command);
  std::ostringstream out;
  out << "_gaussmesh() {\n  local word=\"${COMP_WORDS[COMP_CWORD]}\" words=\n  COMPREPLY=()\n"
      << "  case \"${COMP_WORDS[COMP_CWORD-1]}\" in\n";
  for (const auto& [name, words] : choices)
    out << "    " << name << ") " << (words.empty() ? "return" : "words=\"" + words + "\"") << " ;;\n";
  out << "    *) [ \"$COMP_CWORD\" -eq 1 ] && words=\"" << subcommand_words(program) << "\"\n"
      << "      case \"$word\" in -*) case \"${COMP_WORDS[1]}\" in\n";
  for (const CLI::App* command : subcommands(program))
    out << "        " << command->get_name() << ") words=\"" << option_words(*command) << "\" ;;\n";
  out << "        *) words=\"" << option_words(program) << "\" ;;\n      esac ;; esac ;;\n  esac\n"
      << "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n}\n"
      << "complete -o default -F _gaussmesh gaussmesh\n";
  return out.str();
}

std::string zsh_completion(const CLI::App& program) {
  const auto add_arguments = [](const CLI::App& app, std::ostream& out) {
    out << "_arguments '*:file:_files'";
    for (const CLI::Option* option : dashed_options(app)) {
      for (const std::string& name : dashed_names(*option)) {
        std::string text = escaped(option->get_description(), "[]:\\");
        for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 4) text.replace(at, 1, "'\\''");
        const std::vector<std::string> choices = choices_of(*option);
        const std::string action = choices.empty() ? "_files" : "(" + join_names(choices, " ") + ")";
        out << " \\\n    '*" << name << "[" << text << "]"
            << (value_name(*option).empty() ? "" : ":" + value_name(*option) + ":" + action) << "'";
      }
    }
    out << "\n";
  };
  std::ostringstream out;
  out << "#compdef gaussmesh\ncase \"$words[2]\" in\n";
  for (const CLI::App* command : subcommands(program)) {
    out << "  " << command->get_name() << ") ";
    add_arguments(*command, out);
    out << "  ;;\n";
  }
  out << "  *)\n  if (( CURRENT == 2 )); then\n    compadd " << subcommand_words(program) << "\n  fi\n  ";
  add_arguments(program, out);
  out << "  ;;\nesac\n";
  return out.str();
}

}  // namespace gaussmesh::app
