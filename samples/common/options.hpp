// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_OPTIONS_HPP
#define RSACKERMANN_SAMPLES_OPTIONS_HPP

#include "opencv2/core.hpp"
#include "opencv2/core/utility.hpp"
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace rsackermann_samples {

//! The program was called in a way that it doesn't understand: exit code 2.
struct UsageError : std::runtime_error
{
    explicit UsageError(const std::string& message) : std::runtime_error(message) {}
};

//! A file can't be read, written or understood: exit code 1, or the next input.
struct InputError : std::runtime_error
{
    explicit InputError(const std::string& message) : std::runtime_error(message) {}
};

//! A number that fills the whole text; throws UsageError which names its source otherwise.
double parseNumber(const std::string& text, const std::string& source);
//! A number in [low, high].
double parseNumber(const std::string& text, const std::string& source, double low, double high);
//! A whole number in [low, high].
int parseInteger(const std::string& text, const std::string& source, int low, int high);
//! The position of a word among the words.
int parseWord(const std::string& word, const std::string& source, const std::vector<std::string>& words);
//! WIDTHxHEIGHT, both in [low, high].
cv::Size parseSize(const std::string& text, const std::string& source, int low, int high);
//! Numbers with commas between.
std::vector<double> parseNumbers(const std::string& text, const std::string& source);

/** Options of the form --key=value, and arguments without a dash; behind -- all are arguments.

A cv::CommandLineParser that refuses unknown options instead of ignoring them.
*/
class Options
{
public:
    //! @param keys as for cv::CommandLineParser, without aliases.
    Options(int argc, const char* const* argv, const std::string& keys);

    bool given(const std::string& name) const { return given_.count(name) > 0; }
    std::string text(const std::string& name) const;
    //! The text of an option that names a file which is read, and which no result may replace.
    std::string inputFile(const std::string& name) const;
    //! The text of an option that names a file or a folder that is written; throws UsageError for -, which isn't
    //! standard output here.
    std::string outputFile(const std::string& name) const;
    //! The files of inputFile() so far.
    const std::set<std::string>& inputFiles() const { return inputFiles_; }
    //! A number in [low, high].
    double number(const std::string& name, double low, double high) const;
    //! A number in [1e-9, high]: none that is used is nearer to 0, and the library refuses some that are.
    double positive(const std::string& name, double high) const { return number(name, 1e-9, high); }
    int integer(const std::string& name, int low, int high) const;
    std::vector<double> numbers(const std::string& name) const;
    bool flag(const std::string& name) const;
    //! The position of the value among the words.
    int choice(const std::string& name, const std::vector<std::string>& words) const;
    const std::vector<std::string>& arguments() const { return arguments_; }
    //! Throws UsageError if there are arguments.
    void refuseArguments() const;
    void printHelp(const std::string& about);
    //! Says on standard error what doesn't stop the program.
    void warn(const std::string& message) const;

private:
    std::string program_;
    std::map<std::string, std::string> given_;
    mutable std::set<std::string> inputFiles_;
    std::vector<std::string> arguments_;
    cv::CommandLineParser parser_;
};

//! As many threads as --threads wants, of those that the processors can run: OpenCV's backends complain of others.
void setThreads(const Options& options);

/** Runs a program, or prints its help, and turns exceptions into messages and exit codes: 2 for UsageError, 1 for
everything else.
@param about the beginning of the help.
@param keys as for Options.
@param program returns the exit code. */
int runProgram(const std::string& about, const std::string& keys, int (*program)(const Options&), int argc,
               const char* const* argv);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_OPTIONS_HPP
