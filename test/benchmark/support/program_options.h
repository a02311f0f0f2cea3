#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace concave_distance::benchmark {

/// The command line of a benchmark program: options with the values that they have when they are left out,
/// and the file for the table of results.
class ProgramOptions {
 public:
  explicit ProgramOptions(const std::string& what) : app_(what) {
    app_.add_option("--output", output_, "CSV file to write");
  }

  /// A number of at least `least`.
  template <typename Number>
  void add(const std::string& name, Number& value, const std::string& what, Number least = 0) {
    app_.add_option(name, value, what)->check(CLI::Range(least, std::numeric_limits<Number>::max()));
  }
  /// A text, as the name of a file.
  void add(const std::string& name, std::string& value, const std::string& what) {
    app_.add_option(name, value, what);
  }
  /// A list with commas between its values.
  template <typename Value>
  void add(const std::string& name, std::vector<Value>& values, const std::string& what) {
    app_.add_option(name, values, what)->delimiter(',');
  }
  /// Takes numbers that are at least `least`.
  template <typename Number>
  void add(const std::string& name, std::vector<Number>& values, const std::string& what, Number least) {
    const Number most = std::numeric_limits<Number>::max();
    app_.add_option(name, values, what)->delimiter(',')->check(CLI::Range(least, most));
  }

  /// Reads the command line. False: it ends here, with status().
  bool read(int argc, char** argv) {
    try {
      app_.parse(argc, argv);
      return true;
    } catch (const CLI::ParseError& error) {
      status_ = app_.exit(error);
      return false;
    }
  }
  int status() const { return status_; }
  const std::string& output() const { return output_; }

 private:
  CLI::App app_;
  std::string output_;
  int status_ = 0;
};

}  // namespace concave_distance::benchmark
