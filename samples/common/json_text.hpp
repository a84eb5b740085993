// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_JSON_TEXT_HPP
#define RSACKERMANN_SAMPLES_JSON_TEXT_HPP

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace rsackermann_samples {

//! What the text stands for. Compiled once: the parser is a template that takes the compiler seconds.
//! @param throws whether an exception of JSON tells of an error, or a value that is_discarded().
nlohmann::json parseJson(const std::string& text, bool throws = true);

//! What is wrong, without the library's name for the kind of error.
std::string messageOf(const nlohmann::json::exception& error);

//! Whether there is nothing in a line but spaces.
bool isBlank(const std::string& line);

/** Hands over each line of a report of rsackermann_correct with words for its place, but for blank ones. Throws
InputError with the place if a line isn't JSON or use() throws an exception of JSON. */
void readReportLines(const std::string& path,
                     const std::function<void(const nlohmann::json& line, const std::string& source)>& use);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_JSON_TEXT_HPP
