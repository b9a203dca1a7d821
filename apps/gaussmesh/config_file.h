// The file of options that --config names.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gaussmesh::app {

/// Options in TOML, without sections, such as `decay = 0.4`. The command line comes first: options that stand there
/// are passed over in the file, and so are those that exclude one of these.
class ConfigFile : public CLI::ConfigTOML {
 public:
  /// @param program  has its option --config and must outlive this
  explicit ConfigFile(const CLI::App& program) : program_(program) {}

  /// The options that count. Called by CLI11 when the command line has been read.
  ///
  /// @throws OptionError for what is no option, and for one that is there twice; the message names file and line
  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;

  /// `run.toml:3: ` if `message`, one of CLI11's, is about an option that the file gave; else nothing.
  std::string place_of(const std::string& message) const;

 private:
  struct Given {
    const CLI::Option* option = nullptr;
    std::string place;
  };

  mutable std::vector<Given> given_;  // from_config() is const for CLI11 alone
  const CLI::App& program_;
};

}  // namespace gaussmesh::app
