// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "parsable_text.hpp"
#include "options.hpp"
#include "files.hpp"

#include <cctype>
#include <sstream>

namespace rsackermann_samples {

namespace {

void require(bool condition, const char* message)
{
    if (!condition)
        throw UsageError(message);
}

// Parsers call themselves for nested values, and a file that is nested enough ends the program.
void checkNesting(const std::string& text)
{
    const int largest = 64;
    int depth = 0;
    bool lineBegins = true;
    for (size_t i = 0, dashes = 0; i < text.size(); i++)
    {
        const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : '\0';
        dashes = c == '\n' ? 0 : dashes + (lineBegins && c == '-' && next == ' ');
        lineBegins = c == '\n' || (lineBegins && (c == ' ' || c == '-'));
        if (c == '[' || c == '{' || (c == '<' && std::isalpha((unsigned char)next)))
            depth++;
        else if (c == ']' || c == '}' || (c == '<' && next == '/') || (c == '/' && next == '>'))
            depth--;
        require(depth <= largest && dashes <= size_t(largest), "is nested too deeply");
    }
}

// The parser of cv::FileStorage may search for ever for what comes after the first collection. That ends before the
// file does with "...", or if it isn't a map that begins in the first column.
void checkDocuments(const std::string& text)
{
    std::istringstream lines(text);
    bool begun = false, ended = false;
    for (std::string line; std::getline(lines, line);)
    {
        line.erase(line.find_last_not_of(" \r") + 1);
        const size_t first = line.find_first_not_of(' ');
        if (first == std::string::npos || line[first] == '#' || (!begun && (line[0] == '%' || line == "---")))
            continue;
        require(!ended, "holds more than one document");
        ended = line.compare(0, 3, "...") == 0;
        require(line.size() == 3 || !ended, "has text in the line that ends the document");
        require(begun || std::isalnum((unsigned char)line[0]) || line[0] == '_', "doesn't begin with a key");
        begun = true;
    }
}

} // namespace

std::string readParsableText(const std::string& path)
{
    const std::streamsize largest = 1 << 20;
    std::ifstream file = openText(path);
    require(bool(file), "can't be read");
    std::string text(size_t(largest) + 1, '\0');
    file.read(&text[0], std::streamsize(text.size()));
    require(!file.bad(), "can't be read");
    require(file.gcount() <= largest, "is larger than a megabyte");
    text.resize(size_t(file.gcount()));
    checkNesting(text);
    if (text.compare(0, 5, "%YAML") == 0)
        checkDocuments(text);
    return text;
}

} // namespace rsackermann_samples
