// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "options.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace rsackermann_samples {

namespace {

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);)
        parts.push_back(part);
    return parts;
}

// The names in the keys of a cv::CommandLineParser: "{name | default | help}".
bool isKnown(const std::string& keys, const std::string& name)
{
    for (size_t at = keys.find('{'); at != std::string::npos; at = keys.find('{', at + 1))
    {
        const size_t first = keys.find_first_not_of(' ', at + 1);
        if (keys.compare(first, name.size(), name) == 0 && keys.find_first_of(" |", first) == first + name.size())
            return true;
    }
    return false;
}

// Checks the arguments and gives back the options only: cv::CommandLineParser would skip unknown ones and lose
// arguments.
std::vector<const char*> sortArguments(int argc, const char* const* argv, const std::string& keys,
                                       std::map<std::string, std::string>& given, std::vector<std::string>& arguments)
{
    std::vector<const char*> options(1, argv[0]);
    bool onlyArguments = false; // behind --
    for (int i = 1; i < argc; i++)
    {
        const std::string argument = argv[i];
        if (!onlyArguments && argument == "--")
        {
            onlyArguments = true;
            continue;
        }
        if (onlyArguments || argument.size() < 2 || argument[0] != '-')
        {
            arguments.push_back(argument);
            continue;
        }
        const size_t equals = argument.find('=');
        const std::string name = argument.substr(0, equals).substr(argument[1] == '-' ? 2 : 1);
        if (argument[1] != '-' || name.empty() || name[0] == '@' || !isKnown(keys, name))
            throw UsageError("unknown option " + argument.substr(0, equals));
        if (given.count(name))
            throw UsageError("option --" + name + " is given twice");
        given[name] = equals == std::string::npos ? "" : argument.substr(equals + 1);
        options.push_back(argv[i]);
    }
    return options;
}

std::string printed(double value)
{
    std::ostringstream stream;
    stream << std::setprecision(10) << value; // all digits of a whole number
    return stream.str();
}

} // namespace

double parseNumber(const std::string& text, const std::string& source)
{
    char* end = 0;
    const double value = std::strtod(text.c_str(), &end);
    // Words and hexadecimal numbers aren't what a person means by one.
    const bool isDecimal = text.find_first_not_of("+-.0123456789eE") == std::string::npos;
    if (text.empty() || *end || !isDecimal || !std::isfinite(value))
        throw UsageError(source + ": '" + text + "' is not a number");
    return value;
}

double parseNumber(const std::string& text, const std::string& source, double low, double high)
{
    const double value = parseNumber(text, source);
    if (value < low || value > high)
        throw UsageError(source + ": " + text + " is not from " + printed(low) + " to " + printed(high));
    return value;
}

int parseInteger(const std::string& text, const std::string& source, int low, int high)
{
    const double value = parseNumber(text, source);
    if (value != std::floor(value) || value < low || value > high)
        throw UsageError(source + ": '" + text + "' is not a whole number from " + printed(low) + " to " +
                         printed(high));
    return int(value);
}

int parseWord(const std::string& word, const std::string& source, const std::vector<std::string>& words)
{
    std::string list;
    for (size_t i = 0; i < words.size(); i++)
    {
        if (words[i] == word)
            return int(i);
        list += (i ? ", " : "") + words[i];
    }
    throw UsageError(source + ": '" + word + "' is none of " + list);
}

cv::Size parseSize(const std::string& text, const std::string& source, int low, int high)
{
    const size_t x = text.find('x');
    if (x == std::string::npos)
        throw UsageError(source + ": '" + text + "' is not WIDTHxHEIGHT");
    return cv::Size(parseInteger(text.substr(0, x), source, low, high),
                    parseInteger(text.substr(x + 1), source, low, high));
}

std::vector<double> parseNumbers(const std::string& text, const std::string& source)
{
    std::vector<double> values;
    for (const std::string& part : split(text, ','))
        values.push_back(parseNumber(part, source));
    if (values.empty() || text.back() == ',')
        throw UsageError(source + ": '" + text + "' is not a list of numbers with commas between");
    return values;
}

Options::Options(int argc, const char* const* argv, const std::string& keys) : program_(argv[0]), parser_(1, argv, keys)
{
    const std::vector<const char*> options = sortArguments(argc, argv, keys, given_, arguments_);
    parser_ = cv::CommandLineParser(int(options.size()), options.data(), keys);
}

std::string Options::text(const std::string& name) const
{
    const std::map<std::string, std::string>::const_iterator it = given_.find(name);
    if (it == given_.end())
        return parser_.get<cv::String>(name);
    if (it->second.empty())
        throw UsageError("option --" + name + " needs a value: --" + name + "=VALUE");
    return it->second;
}

std::string Options::inputFile(const std::string& name) const
{
    return *inputFiles_.insert(text(name)).first;
}

std::string Options::outputFile(const std::string& name) const
{
    const std::string path = text(name);
    if (path == "-")
        throw UsageError("option --" + name + ": - isn't standard output here; ./- is a file of this name");
    return path;
}

double Options::number(const std::string& name, double low, double high) const
{
    return parseNumber(text(name), "option --" + name, low, high);
}

int Options::integer(const std::string& name, int low, int high) const
{
    return parseInteger(text(name), "option --" + name, low, high);
}

std::vector<double> Options::numbers(const std::string& name) const
{
    return parseNumbers(text(name), "option --" + name);
}

bool Options::flag(const std::string& name) const
{
    const std::map<std::string, std::string>::const_iterator it = given_.find(name);
    if (it == given_.end())
        return false;
    if (!it->second.empty() && it->second != "true" && it->second != "false")
        throw UsageError("option --" + name + " is either given or not: '" + it->second + "' is no value for it");
    return it->second != "false";
}

int Options::choice(const std::string& name, const std::vector<std::string>& words) const
{
    return parseWord(text(name), "option --" + name, words);
}

void Options::refuseArguments() const
{
    if (!arguments_.empty())
        throw UsageError("unknown argument " + arguments_[0]);
}

void Options::printHelp(const std::string& about)
{
    parser_.about(about);
    parser_.printMessage();
}

void Options::warn(const std::string& message) const
{
    std::cerr << program_ << ": " << message << std::endl;
}

void setThreads(const Options& options)
{
    if (options.given("threads"))
        cv::setNumThreads(std::min(options.integer("threads", 1, 4096), cv::getNumberOfCPUs()));
}

// What a program prints may be all that it does.
static int checkOutput(const char* program, int exitCode)
{
    std::cout.flush();
    if (exitCode != 0 || (std::fflush(stdout) == 0 && !std::ferror(stdout) && std::cout))
        return exitCode;
    std::cerr << program << ": standard output can't be written" << std::endl;
    return 1;
}

int runProgram(const std::string& about, const std::string& keys, int (*program)(const Options&), int argc,
               const char* const* argv)
{
    try
    {
        Options options(argc, argv, keys);
        if (options.given("help"))
        {
            options.printHelp(about);
            return checkOutput(argv[0], 0);
        }
        return checkOutput(argv[0], program(options));
    }
    catch (const UsageError& e)
    {
        std::cerr << argv[0] << ": " << e.what() << " (see --help)" << std::endl;
        return 2;
    }
    catch (const cv::Exception& e)
    {
        std::cerr << argv[0] << ": " << e.err << std::endl;
        return 1;
    }
    catch (const std::exception& e)
    {
        std::cerr << argv[0] << ": " << e.what() << std::endl;
        return 1;
    }
}

} // namespace rsackermann_samples
