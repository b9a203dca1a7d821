#include "manual.h"

#include <sstream>
#include <vector>

#include "gaussmesh/version.h"

namespace gaussmesh::app {
namespace {

/// The options that help shows, in its order.
std::vector<const CLI::Option*> shown_options(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::vector<const CLI::App*> subcommands(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

/// Its names with their dashes, short ones first.
std::vector<std::string> dashed_names(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

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

void add_options(const CLI::App& app, std::ostream& out) {
  for (const CLI::Option* option : shown_options(app)) {
    std::string names;
    for (const std::string& name : dashed_names(*option)) names += (names.empty() ? "" : ", ") + name;
    const bool is_positional = names.empty();
    out << ".TP\n\\fB" << roff(names) << "\\fR" << (is_positional || option->get_type_size() == 0 ? "" : " ");
    if (is_positional || option->get_type_size() != 0) out << "\\fI" << roff(option->get_type_name()) << "\\fR";
    out << "\n" << roff(option->get_description()) << "\n";
  }
}

/// All options of the program or a sub-command, with blanks between them.
std::string option_words(const CLI::App& app) {
  std::string words;
  for (const CLI::Option* option : shown_options(app))
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
      << ".B gaussmesh\n\\fIMOL\\fR \\fB\\-o\\fR \\fIFILE\\fR [\\fIOPTIONS\\fR]\n";
  for (const CLI::App* command : subcommands(program))
    out << ".br\n.B gaussmesh " << command->get_name() << "\n[\\fIOPTIONS\\fR]\n";
  out << ".SH DESCRIPTION\n.nf\n" << roff(program.get_description()) << "\n.fi\n.SH OPTIONS\n";
  add_options(program, out);
  for (const CLI::App* command : subcommands(program)) {
    out << ".SH GAUSSMESH " << command->get_name() << "\n" << roff(command->get_description()) << "\n";
    add_options(*command, out);
  }
  out << ".SH EXAMPLES AND EXIT CODES\n.nf\n" << roff(program.get_footer()) << "\n.fi\n";
  return out.str();
}

std::string bash_completion(const CLI::App& program) {
  std::ostringstream out;
  out << "_gaussmesh() {\n  local words\n  case \"${COMP_WORDS[1]}\" in\n";
  for (const CLI::App* command : subcommands(program))
    out << "    " << command->get_name() << ") words=\"" << option_words(*command) << "\" ;;\n";
  out << "    *) words=\"" << option_words(program) << "\" ;;\n  esac\n"
      << "  [ \"$COMP_CWORD\" -eq 1 ] && words=\"$words " << subcommand_words(program) << "\"\n"
      << "  COMPREPLY=($(compgen -W \"$words\" -- \"${COMP_WORDS[COMP_CWORD]}\"))\n}\n"
      << "complete -o default -F _gaussmesh gaussmesh\n";
  return out.str();
}

std::string zsh_completion(const CLI::App& program) {
  const auto add_arguments = [](const CLI::App& app, std::ostream& out) {
    out << "_arguments '*:file:_files'";
    for (const CLI::Option* option : shown_options(app)) {
      for (const std::string& name : dashed_names(*option)) {
        std::string text = escaped(option->get_description(), "[]:\\");
        for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 4)
          text.replace(at, 1, "'\\''");
        out << " \\\n    '*" << name << "[" << text << "]" << (option->get_type_size() == 0 ? "" : ":value:_files")
            << "'";
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
  out << "  *)\n  if (( CURRENT == 2 )); then\n    compadd";
  for (const CLI::App* command : subcommands(program)) out << " " << command->get_name();
  out << "\n  fi\n  ";
  add_arguments(program, out);
  out << "  ;;\nesac\n";
  return out.str();
}

}  // namespace gaussmesh::app
