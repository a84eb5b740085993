// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "json_text.hpp"
#include "files.hpp"

namespace rsackermann_samples {

nlohmann::json parseJson(const std::string& text, bool throws)
{
    return nlohmann::json::parse(text, nullptr, throws);
}

std::string messageOf(const nlohmann::json::exception& error)
{
    const std::string text = error.what(); // begins with [json.exception.KIND.NUMBER]
    return text.substr(text.find(' ') + 1);
}

bool isBlank(const std::string& line)
{
    return line.find_first_not_of(" \t\r") == std::string::npos;
}

void readReportLines(const std::string& path,
                     const std::function<void(const nlohmann::json& line, const std::string& source)>& use)
{
    std::ifstream file = openText(path);
    if (!file)
        throw InputError(path + " can't be read");
    int number = 0;
    bool hasLine = false;
    for (std::string text; std::getline(file, text);)
    {
        const std::string source = path + cv::format(", line %d", ++number);
        if (isBlank(text))
            continue;
        hasLine = true;
        try
        {
            use(parseJson(text), source);
        }
        catch (const nlohmann::json::exception& e)
        {
            throw InputError(source + " isn't one of a report: " + messageOf(e));
        }
    }
    if (!hasLine)
        throw InputError(path + " has no lines");
}

} // namespace rsackermann_samples
