// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "gyro_file.hpp"
#include "csv.hpp"
#include "options.hpp"
#include "units.hpp"

#include <algorithm>
#include <cctype>
#include <cfloat>
#include <cmath>
#include <iostream>
#include <map>
#include <vector>

namespace rsackermann_samples {

namespace {

const double FASTEST = 1e3;         // rad/s, as the library accepts
const double LATEST = 1e12;         // seconds
const double GAP = 0.1;             // seconds without a sample
const double FASTEST_CLOCK = 32000; // samples a second, the most that usual gyros give
const double FULL_SCALE = 100;      // deg/s, which the smallest range of usual gyros exceeds
const int SATURATED = 3;            // samples in a row that have the largest value of all
const char* const GCSV_TITLES[] = {"GYROFLOW IMU LOG", "CAMERA IMU LOG"};

struct Samples
{
    std::vector<double> times;
    std::vector<cv::Vec3d> rates;
};

// The largest or the smallest rate again and again is an end of the gyro's range.
void warnOfSaturation(const CsvTable& table, const Samples& samples, const std::string (&names)[4],
                      const std::string& program)
{
    for (int k = 0; k < 3; k++)
    {
        double ends[] = {-FULL_SCALE * DEGREE, FULL_SCALE * DEGREE};
        for (const cv::Vec3d& rate : samples.rates)
        {
            ends[0] = std::min(ends[0], rate[k]);
            ends[1] = std::max(ends[1], rate[k]);
        }
        int repeated = 0;
        for (size_t i = 0; i < samples.rates.size() && repeated < SATURATED; i++)
        {
            const double rate = samples.rates[i][k];
            repeated = rate == ends[0] || rate == ends[1] ? repeated + 1 : 0;
            if (repeated == SATURATED)
                std::cerr << program << ": " << table.placeOf(i, names[k + 1])
                          << cv::format(": the gyro saturates at %g deg/s", std::abs(rate) / DEGREE) << std::endl;
        }
    }
}

// If all samples are as far apart as in gaps, or closer than a gyro takes them, the unit is another.
void warnOfTimes(const CsvTable& table, const Samples& samples, const std::string& timeName, const std::string& program)
{
    size_t gaps = 0, first = 1;
    double shortest = DBL_MAX, longest = 0;
    for (size_t i = 1; i < samples.times.size(); i++)
    {
        const double interval = samples.times[i] - samples.times[i - 1];
        shortest = std::min(shortest, interval);
        longest = std::max(longest, interval);
        if (interval > GAP && gaps++ == 0)
            first = i;
    }
    std::string warning;
    if (shortest > GAP)
        warning =
            cv::format("no sample is less than %g s after the one before: times seem not to be in seconds", shortest);
    else if (longest < 1 / FASTEST_CLOCK)
        warning =
            cv::format("no sample is more than %g s after the one before: times seem not to be in seconds", longest);
    else if (gaps > 0)
        warning =
            cv::format("%g s without a sample; frames in gaps of more than %g s, of which there are %d, do without "
                       "the gyro",
                       samples.times[first] - samples.times[first - 1], GAP, int(gaps));
    if (!warning.empty())
        std::cerr << program << ": " << table.placeOf(first, timeName) << ": " << warning << std::endl;
}

/** Numbers of a time and three rates, with warnings of what is doubtful about them.
@param names of the columns. @param scales seconds and rad/s of their units. */
Samples readSamples(const CsvTable& table, const std::string (&names)[4], const double (&scales)[4],
                    const std::string& program)
{
    const std::vector<size_t> columns = table.columns(std::vector<std::string>(names, names + 4));
    Samples samples;
    for (size_t i = 0; i < table.rows.size(); i++)
    {
        double values[4];
        for (int k = 0; k < 4; k++)
        {
            values[k] = table.number(i, columns[size_t(k)]) * scales[k];
            const double limit = k == 0 ? LATEST : FASTEST;
            if (!(std::abs(values[k]) <= limit))
                throw UsageError(table.placeOf(i, names[k]) + cv::format(": %s is not from %g to %g",
                                                                         table.rows[i][columns[size_t(k)]].c_str(),
                                                                         -limit / scales[k], limit / scales[k]));
        }
        if (!samples.times.empty() && !(values[0] > samples.times.back()))
            throw UsageError(table.placeOf(i, names[0]) + ": times must increase");
        samples.times.push_back(values[0]);
        samples.rates.push_back(cv::Vec3d(values[1], values[2], values[3]));
    }
    if (samples.times.size() < 2)
        throw UsageError(table.path + ": there are fewer than two samples");
    warnOfSaturation(table, samples, names, program);
    warnOfTimes(table, samples, names[0], program);
    return samples;
}

/** The camera's axes from those of a log. After its orientation string they are Gyroflow's
(gyroflow-docs, logging/orientation.md): x up, y to the left and z backwards. A capital letter
names the axis of the log that is one of them, a small one its opposite. */
cv::Matx33d axesOf(const std::string& orientation, const std::string& place)
{
    cv::Matx33d axes = cv::Matx33d::zeros(); // of the log to Gyroflow's
    std::string used;
    for (size_t i = 0; i < orientation.size() && i < 3; i++)
    {
        const char lower = char(std::tolower(orientation[i]));
        if (lower >= 'x' && lower <= 'z' && used.find(lower) == std::string::npos)
        {
            used += lower;
            axes(int(i), lower - 'x') = orientation[i] == lower ? -1 : 1;
        }
    }
    if (orientation.size() != 3 || used.size() != 3)
        throw UsageError(place + ": '" + orientation +
                         "' is not X, Y and Z in some order, small letters for opposites");
    return cv::Matx33d(0, -1, 0, -1, 0, 0, 0, 0, -1) * axes;
}

bool isGcsv(const std::vector<std::string>& header)
{
    return header.size() == 1 && (header[0] == GCSV_TITLES[0] || header[0] == GCSV_TITLES[1]);
}

Samples readGcsv(CsvTable table, const std::string& program)
{
    // What Gyroflow takes for what isn't there.
    double scales[4] = {0.001, 1, 1, 1};
    cv::Matx33d axes = axesOf("xzY", table.path);
    std::map<std::string, int> lines; // of the keys
    size_t i = 0;
    for (; i < table.rows.size() && table.rows[i][0] != "t"; i++)
    {
        const std::vector<std::string>& row = table.rows[i];
        const std::string key = row[0], place = table.placeOf(i, key);
        const int first = lines.insert(std::make_pair(key, table.lines[i])).first->second;
        if (first != table.lines[i])
            throw UsageError(place + cv::format(": it is there twice, in line %d as well", first));
        if ((key == "tscale" || key == "gscale" || key == "orientation") && row.size() != 2)
            throw UsageError(place + ": one value is expected");
        else if (key == "orientation")
            axes = axesOf(row[1], place);
        else if (key == "tscale" || key == "gscale")
        {
            const double scale = parseNumber(row[1], place);
            if (!(scale > 0 && scale <= 1e6))
                throw UsageError(place + ": " + row[1] + " is not above 0 and up to 1e6");
            std::fill(scales + (key == "tscale" ? 0 : 1), scales + (key == "tscale" ? 1 : 4), scale);
        }
    }
    if (i == table.rows.size())
        throw UsageError(table.path + ": there is no line that begins with 't,'");
    table.beginAt(i);
    const std::string names[4] = {"t", "gx", "gy", "gz"};
    Samples samples = readSamples(table, names, scales, program);
    for (cv::Vec3d& rate : samples.rates)
        rate = axes * rate;
    return samples;
}

Samples readColumns(const CsvTable& table, const std::string& program)
{
    // In the order of the camera's axes.
    const std::string names[4] = {"time_s", "pitch_rate_deg_s", "yaw_rate_deg_s", "roll_rate_deg_s"};
    const double scales[4] = {1, DEGREE, DEGREE, DEGREE};
    for (size_t i = 0; i < table.header.size(); i++)
        if (std::find(names, names + 4, table.header[i]) == names + 4)
            throw UsageError(cv::format("column %d of %s: '%s' is none of time_s, yaw_rate_deg_s, pitch_rate_deg_s, "
                                        "roll_rate_deg_s",
                                        int(i + 1), table.path.c_str(), table.header[i].c_str()));
    Samples samples = readSamples(table, names, scales, program);
    for (cv::Vec3d& rate : samples.rates)
        rate[0] = -rate[0]; // looking down is a turn against the x axis
    return samples;
}

} // namespace

const char* const GYRO_KEYS =
    "{gyro       |        | rates of a gyro on the camera, on the clock of time_s or of the video: CSV file (columns "
    "time_s, yaw_rate_deg_s, pitch_rate_deg_s, roll_rate_deg_s) or a log of Gyroflow (.gcsv)}"
    "{gyro_delay |        | seconds by which the clock of --gyro is ahead of that of the frames (default: found in "
    "sequences that shake)}";

GyroRecording readGyroOptions(const Options& options, const std::string& program)
{
    if (!options.given("gyro") && options.given("gyro_delay"))
        throw UsageError("--gyro_delay needs --gyro");
    if (!options.given("gyro"))
        return GyroRecording();
    GyroRecording gyro = readGyro(options.inputFile("gyro"), program);
    gyro.isClockKnown = options.given("gyro_delay");
    if (gyro.isClockKnown)
        gyro.times -= options.number("gyro_delay", -1e12, 1e12);
    return gyro;
}

GyroRecording readGyro(const std::string& path, const std::string& program)
{
    const CsvTable table = readCsv(path, isGcsv);
    const Samples samples = isGcsv(table.header) ? readGcsv(table, program) : readColumns(table, program);
    GyroRecording recording;
    recording.times = cv::Mat(samples.times, true);
    recording.rates = cv::Mat(samples.rates, true).reshape(1);
    return recording;
}

} // namespace rsackermann_samples
