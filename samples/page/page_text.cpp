// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "page_text.hpp"
#include "page_template.hpp"
#include "json_text.hpp"

namespace rsackermann_samples {

using nlohmann::json;

std::vector<json> readPageFrames(const std::string& report)
{
    std::vector<json> frames;
    std::map<std::pair<std::string, int>, size_t> places;
    readReportLines(report, [&](const json& line, const std::string&) {
        line.at("status").get<std::string>();
        const auto name = std::make_pair(line.at("input").get<std::string>(), line.value("frame", -1));
        const size_t place = places.insert(std::make_pair(name, frames.size())).first->second;
        frames.resize(std::max(frames.size(), place + 1));
        frames[place] = line;
        for (const char* large : {"relief", "rotation_curve", "covariance"})
            frames[place].erase(large);
    });
    return frames;
}

std::string pageText(const json& data)
{
    const std::string page = PAGE_TEMPLATE, place = "id=\"drive\">";
    const size_t begin = page.find(place) + place.size();
    std::string text = page.substr(0, begin);
    for (const char c : data.dump(-1, ' ', false, json::error_handler_t::replace))
        text += c == '<' ? std::string("\\u003c") : std::string(1, c); // no name ends the element of the data
    return text + page.substr(begin);
}

std::string dataAddress(const std::vector<unsigned char>& jpeg)
{
    const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string address = "data:image/jpeg;base64,";
    for (size_t i = 0; i < jpeg.size(); i += 3)
    {
        unsigned bits = 0;
        for (size_t k = i; k < i + 3; k++)
            bits = bits << 8 | (k < jpeg.size() ? jpeg[k] : 0u);
        for (size_t k = 0; k < 4; k++)
            address += i + k <= jpeg.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return address;
}

} // namespace rsackermann_samples
