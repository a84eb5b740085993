// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "parsable_text.hpp"
#include "options.hpp"

#include <cctype>
#include <fstream>
#include <yaml-cpp/yaml.h>

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

bool hasDirective(const std::string& text)
{
    return text.compare(0, 5, "%YAML") == 0;
}

void checkDocuments(const std::string& text)
try
{
    require(!hasDirective(text) || YAML::LoadAll(withoutDirective(text)).size() <= 1, "holds more than one document");
}
catch (const YAML::Exception& e)
{
    throw UsageError(e.what());
}

} // namespace

std::string withoutDirective(const std::string& text)
{
    return hasDirective(text) ? text.substr(std::min(text.find('\n'), text.size())) : text;
}

std::string readParsableText(const std::string& path)
{
    const std::streamoff largest = 1 << 20;
    std::ifstream file(path.c_str(), std::ios::binary | std::ios::ate);
    const std::streamoff size = file.tellg();
    require(size >= 0, "can't be read");
    require(size <= largest, "is larger than a megabyte");
    std::string text(size_t(size), '\0');
    file.seekg(0);
    require(size == 0 || file.read(&text[0], size), "can't be read");
    checkNesting(text);
    checkDocuments(text);
    return text;
}

} // namespace rsackermann_samples
