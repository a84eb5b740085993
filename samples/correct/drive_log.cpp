// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "drive_log.hpp"
#include "csv.hpp"
#include "files.hpp"
#include "options.hpp"

#include <algorithm>
#include <climits>
#include <cmath>
#include <limits>
#include <set>

namespace rsackermann_samples {

namespace {

const double UNKNOWN = std::numeric_limits<double>::quiet_NaN();

// A column with numbers, and its range.
struct Column
{
    const char* name;
    double FrameFacts::*value;
    double low, high;
    bool lowIsAccepted;
};

const Column COLUMNS[] = {{"time_s", &FrameFacts::time, -1e12, 1e12, true},
                          {"speed_kmh", &FrameFacts::speed, -1000, 1000, true},
                          {"speed_sigma_kmh", &FrameFacts::speedSigma, 0, 1000, false},
                          {"yaw_rate_deg_s", &FrameFacts::yawRate, -1000, 1000, true},
                          {"yaw_rate_sigma_deg_s", &FrameFacts::yawRateSigma, 0, 1000, false},
                          {"roll_deg", &FrameFacts::roll, -89, 89, true},
                          {"pitch_deg", &FrameFacts::pitch, -89, 89, true},
                          {"gravity_sigma_deg", &FrameFacts::gravitySigma, 0, 45, true}};

const Column* findColumn(const std::string& name)
{
    for (const Column& column : COLUMNS)
        if (name == column.name)
            return &column;
    return nullptr;
}

void checkHeader(const std::vector<std::string>& header, const std::string& path)
{
    for (size_t i = 0; i < header.size(); i++)
    {
        const std::string place = cv::format("column %d of %s: '%s'", int(i + 1), path.c_str(), header[i].c_str());
        if (header[i] != "file" && header[i] != "frame" && !findColumn(header[i]))
        {
            std::string names = "file, frame";
            for (const Column& column : COLUMNS)
                names += std::string(", ") + column.name;
            throw UsageError(place + " is none of " + names);
        }
    }
    // A standard deviation alone would have no effect.
    for (const char* name : {"speed_sigma_kmh", "yaw_rate_sigma_deg_s"})
    {
        std::string measured = name;
        measured.erase(measured.find("sigma_"), 6);
        if (std::count(header.begin(), header.end(), name) && !std::count(header.begin(), header.end(), measured))
            throw UsageError(path + ": the column " + name + " needs the column " + measured);
    }
}

double readCell(const Column& column, const std::string& cell, const std::string& place)
{
    if (cell.empty())
        return UNKNOWN;
    const double value = parseNumber(cell, place);
    if (value < column.low || value > column.high || (!column.lowIsAccepted && value == column.low))
        throw UsageError(place + cv::format(": %s is not %s %g %s %g", cell.c_str(),
                                            column.lowIsAccepted ? "from" : "above", column.low,
                                            column.lowIsAccepted ? "to" : "and up to", column.high));
    return value;
}

// The value at a time between two samples that give it.
double interpolated(const std::vector<FrameFacts>& samples, double time, double FrameFacts::*value)
{
    const auto isGiven = [value](const FrameFacts& sample) { return !std::isnan(sample.*value); };
    const auto after = std::lower_bound(samples.begin(), samples.end(), time,
                                        [](const FrameFacts& a, double t) { return a.time < t; });
    const auto right = std::find_if(after, samples.end(), isGiven);
    if (right != samples.end() && right->time == time)
        return *right.*value;
    const auto left = std::find_if(std::make_reverse_iterator(after), samples.rend(), isGiven);
    if (left == samples.rend() || right == samples.end())
        return UNKNOWN;
    const double share = (time - left->time) / (right->time - left->time);
    return (1 - share) * (*left.*value) + share * (*right.*value);
}

} // namespace

FrameFacts::FrameFacts()
    : time(UNKNOWN), speed(UNKNOWN), speedSigma(UNKNOWN), yawRate(UNKNOWN), yawRateSigma(UNKNOWN), roll(UNKNOWN),
      pitch(UNKNOWN), gravitySigma(UNKNOWN), intervals(1), isLogged(false)
{
}

DriveLog::DriveLog(const std::string& path) : path_(path)
{
    const CsvTable table = readCsv(path);
    checkHeader(table.header, path);
    for (size_t i = 0; i < table.rows.size(); i++)
    {
        const std::string row = cv::format("line %d of %s", table.lines[i], path.c_str());
        Key key("", -1);
        FrameFacts facts;
        for (size_t k = 0; k < table.header.size(); k++)
        {
            const std::string &name = table.header[k], &cell = table.rows[i][k], place = table.placeOf(i, name);
            if (name == "file")
                key.first = cell;
            else if (name != "frame")
                facts.*findColumn(name)->value = readCell(*findColumn(name), cell, place);
            else if (!cell.empty())
                key.second = parseInteger(cell, place, 0, INT_MAX);
        }
        const bool namesImage = !key.first.empty() && !isVideo(key.first);
        if (namesImage)
            key.second = -1; // the file's name says all
        if (namesImage || key.second >= 0)
        {
            const auto other = named_.insert(std::make_pair(key, Row{facts, table.lines[i]}));
            if (!other.second)
                throw UsageError(row + cv::format(": the frame is that of line %d", other.first->second.line));
            continue;
        }
        std::vector<FrameFacts>& samples = samples_[key.first];
        if (std::isnan(facts.time))
            throw UsageError(row + ": there is neither a frame's name nor a time (columns file, frame, time_s)");
        if (!samples.empty() && !(facts.time > samples.back().time))
            throw UsageError(table.placeOf(i, "time_s") + ": times must increase");
        samples.push_back(facts);
    }
}

FrameFacts DriveLog::of(const std::string& file, int number, double time) const
{
    const FrameFacts* row = named(file, number);
    FrameFacts facts = row ? *row : FrameFacts();
    if (std::isnan(facts.time))
        facts.time = time;
    const std::vector<FrameFacts>* samples = samplesOf(file);
    facts.isLogged = samples_.empty()
                         ? row != nullptr
                         : samples && facts.time >= samples->front().time && facts.time <= samples->back().time;
    if (samples)
        for (const Column& column : COLUMNS)
            if (std::isnan(facts.*column.value) && !std::isnan(facts.time))
                facts.*column.value = interpolated(*samples, facts.time, column.value);
    return facts;
}

std::string DriveLog::nameOf(const std::string& file) const
{
    for (const std::string& name : {file, fileName(file)})
    {
        const std::map<Key, Row>::const_iterator row = named_.lower_bound(Key(name, -1));
        if (samples_.count(name) || (row != named_.end() && row->first.first == name))
            return name;
    }
    return "";
}

void DriveLog::checkNames(const InputList& inputs) const
{
    std::map<std::string, std::set<std::string>> inputsOfNames; // by the name without folders
    bool hasVideo = false;
    for (const Input& input : inputs.inputs)
    {
        inputsOfNames[fileName(input.name)].insert(input.name);
        hasVideo |= isVideo(input.name);
    }
    for (const Input& input : inputs.inputs)
    {
        const bool isImage = !isVideo(input.name);
        std::vector<std::string> names(1, input.name);
        if (fileName(input.name) != input.name && inputsOfNames[fileName(input.name)].size() == 1)
            names.push_back(fileName(input.name));
        if (!isImage || !hasVideo) // else numbers alone may be those of the video's frames
            names.push_back("");
        std::map<int, int> lines; // by the frame
        for (const std::string& name : names)
        {
            const int first = !isImage ? 0 : name.empty() ? input.number : -1, last = isImage ? first : INT_MAX;
            for (auto row = named_.lower_bound(Key(name, first)); row != named_.end() && row->first <= Key(name, last);
                 ++row)
            {
                const int frame = isImage ? input.number : row->first.second, line = row->second.line,
                          other = lines.insert(std::make_pair(frame, line)).first->second;
                if (other != line)
                    throw UsageError(cv::format("lines %d and %d of %s both name %s %d, %s", std::min(line, other),
                                                std::max(line, other), path_.c_str(), isImage ? "image" : "frame",
                                                frame, input.name.c_str()));
            }
        }
    }
}

bool DriveLog::hasNumberAlone() const
{
    return !named_.empty() && named_.begin()->first.first.empty(); // the first one in the order of names
}

const FrameFacts* DriveLog::named(const std::string& file, int number) const
{
    for (const std::string& name : {file, fileName(file), std::string()})
    {
        const std::map<Key, Row>::const_iterator it =
            named_.find(Key(name, isVideo(file) || name.empty() ? number : -1));
        if (it != named_.end())
            return &it->second.facts;
    }
    return nullptr;
}

const std::vector<FrameFacts>* DriveLog::samplesOf(const std::string& file) const
{
    for (const std::string& name : {file, fileName(file), std::string()})
    {
        const std::map<std::string, std::vector<FrameFacts>>::const_iterator it = samples_.find(name);
        if (it != samples_.end())
            return &it->second;
    }
    return nullptr;
}

std::string DriveLog::whyUseless() const
{
    if (samples_.empty())
        return "the log has no effect: its rows name none of the frames (columns file and frame)";
    double first = std::numeric_limits<double>::max(), last = -first;
    for (const std::pair<const std::string, std::vector<FrameFacts>>& entry : samples_)
    {
        first = std::min(first, entry.second.front().time);
        last = std::max(last, entry.second.back().time);
    }
    return cv::format("the samples of the log have no effect: all frames are outside of their times, %.12g to %.12g s: "
                      "their clock may be another (that of a video begins at 0), or the column file names other videos",
                      first, last);
}

double DriveLog::shortestStep() const
{
    double shortest = 0;
    for (const std::pair<const std::string, std::vector<FrameFacts>>& entry : samples_)
        for (size_t i = 1; i < entry.second.size() && entry.second.size() > 2; i++)
        {
            const double step = entry.second[i].time - entry.second[i - 1].time;
            shortest = shortest > 0 ? std::min(shortest, step) : step;
        }
    return shortest;
}

bool DriveLog::has(double FrameFacts::*value) const
{
    const auto isGiven = [value](const FrameFacts& facts) { return !std::isnan(facts.*value); };
    for (const std::pair<const Key, Row>& entry : named_)
        if (isGiven(entry.second.facts))
            return true;
    for (const std::pair<const std::string, std::vector<FrameFacts>>& entry : samples_)
        if (std::any_of(entry.second.begin(), entry.second.end(), isGiven))
            return true;
    return false;
}

} // namespace rsackermann_samples
