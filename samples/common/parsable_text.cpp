// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "parsable_text.hpp"
#include "options.hpp"

#include <cctype>
#include <memory>
#include <sstream>
#include <zlib.h>

namespace rsackermann_samples {

namespace {

void require(bool condition, const std::string& message)
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

std::string readParsableText(const std::string& path, size_t largest)
{
    const std::string mark = "\xEF\xBB\xBF"; // of UTF-8
    const std::shared_ptr<gzFile_s> file(gzopen(path.c_str(), "rb"), [](gzFile f) { gzclose(f); });
    require(bool(file), "can't be read");
    std::string text;
    char block[1 << 16];
    for (int count; text.size() <= largest && (count = gzread(file.get(), block, sizeof block)) > 0;)
        text.append(block, size_t(count));
    require(text.size() <= largest, cv::format("is larger than %zu bytes", largest));
    int error = Z_OK;
    gzerror(file.get(), &error);
    require(error == Z_OK, "can't be read");
    if (text.compare(0, mark.size(), mark) == 0)
        text.erase(0, mark.size());
    checkNesting(text);
    if (text.compare(0, 5, "%YAML") == 0)
        checkDocuments(text);
    return text;
}

cv::FileStorage readStorage(const std::string& path, size_t largest)
try
{
    const std::string text = readParsableText(path, largest);
    cv::FileStorage storage;
    bool isMap = false;
    try
    {
        isMap = storage.open(text, cv::FileStorage::READ | cv::FileStorage::MEMORY) && storage.root().isMap();
    }
    catch (const std::exception&) // those of the standard library come out of OpenCV's parser, too
    {
    }
    require(isMap, "is no file of cv::FileStorage");
    return storage;
}
catch (const UsageError& e)
{
    throw InputError(path + " " + e.what());
}

} // namespace rsackermann_samples
