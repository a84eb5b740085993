// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "report_file.hpp"
#include "json_text.hpp"
#include "report.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include <algorithm>
#include <iostream>
#include <map>

namespace rsackermann_samples {

namespace {

// The input of a line; empty if it isn't a line of a report.
std::string inputOf(const nlohmann::json& line)
{
    return line.is_object() && line.contains("input") && line["input"].is_string() ? line["input"].get<std::string>()
                                                                                   : "";
}

bool isFailure(const nlohmann::json& line)
{
    return line.contains("status") && line["status"] == "failed";
}

// How many frames the video of a line has; 0 if it doesn't say so, which no number of lines makes complete.
int framesOf(const nlohmann::json& line)
{
    return line["frames"].is_number_integer() ? std::max(0, line["frames"].get<int>()) : 0;
}

} // namespace

ReportFile::ReportFile(const Job& job) : path_(job.report == "-" ? "" : job.report), lines_(path_)
{
    for (const Input& input : job.inputs.inputs)
        own_.insert(nameInReport(input.name));
    if (!path_.empty())
        prepare(job);
}

void ReportFile::prepare(const Job& job)
{
    const bool alone = job.shardCount == 1;
    if (cv::utils::fs::isDirectory(path_))
        throw InputError(path_ + " is a folder");
    if (job.skipExisting)
    {
        findComplete();
        lines_.filter([&](const std::string& line) {
            const std::string input = inputOf(parseJson(line, false));
            return !own_.count(input) || complete_.count(input);
        });
    }
    else if (job.overwrite)
        lines_.filter([&](const std::string& line) { return !alone && !own_.count(inputOf(parseJson(line, false))); });
    else
        // Other shards may have begun the file.
        lines_.filter([&](const std::string& line) {
            if (alone || own_.count(inputOf(parseJson(line, false))))
                throw InputError(path_ + " exists (--overwrite replaces it)");
            return true;
        });
}

void ReportFile::findComplete()
{
    std::map<std::string, int> missing; // frames of videos
    std::set<std::string> failed;
    lines_.filter([&](const std::string& text) {
        const nlohmann::json line = parseJson(text, false);
        const std::string input = inputOf(line);
        if (!own_.count(input))
            return true;
        if (isFailure(line))
            failed.insert(input);
        else if (line.contains("frames"))
            missing.insert(std::make_pair(input, framesOf(line))).first->second--;
        else
            complete_.insert(input);
        return true;
    });
    for (const std::pair<const std::string, int>& video : missing)
        if (video.second == 0)
            complete_.insert(video.first);
    for (const std::string& input : failed)
        complete_.erase(input);
}

bool ReportFile::has(const std::string& input) const
{
    return complete_.count(nameInReport(input)) > 0;
}

void ReportFile::add(const std::vector<std::string>& lines)
{
    if (!path_.empty())
    {
        lines_.append(lines);
        return;
    }
    for (const std::string& line : lines)
        std::cout << line << '\n';
    if (!std::cout.flush())
        throw InputError("standard output can't be written");
}

} // namespace rsackermann_samples
