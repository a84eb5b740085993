// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_TEST_SAMPLES_PROGRAM_HPP
#define RSACKERMANN_TEST_SAMPLES_PROGRAM_HPP

#include "opencv2/ts.hpp"
#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/imgcodecs.hpp"
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/resource.h>
#include <vector>

// GoogleTest would take JSON for a container of JSON, without end.
namespace nlohmann {
inline void PrintTo(const json& value, std::ostream* stream)
{
    *stream << value.dump();
}
inline void PrintTo(const ordered_json& value, std::ostream* stream)
{
    *stream << value.dump();
}
} // namespace nlohmann

namespace opencv_test {

typedef std::vector<std::string> Arguments;

inline Arguments operator+(Arguments a, const Arguments& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

//! The outcome of a program.
struct Outcome
{
    int exitCode; //!< -1 if it was ended by a signal
    std::string output, messages;
};

//! Runs a command of the shell.
Outcome runCommand(const std::string& command);
Outcome runProgram(const std::string& program, const Arguments& arguments);
inline Outcome correct(const Arguments& arguments)
{
    return runProgram(CORRECT_PROGRAM, arguments);
}
inline Outcome simulate(const Arguments& arguments)
{
    return runProgram(SIMULATE_PROGRAM, arguments);
}
inline Outcome evaluate(const Arguments& arguments)
{
    return runProgram(EVALUATE_PROGRAM, arguments);
}

//! A program that runs beside the test; what it writes to the terminal is lost.
class RunningProgram
{
public:
    RunningProgram(const std::string& program, Arguments arguments);
    void send(int signal) const { kill(process_, signal); }
    //! Waits for the end. @return the exit code, -1 if a signal has ended it.
    int wait();
    //! The most memory that it had at once, once it has ended.
    double peakMegabytes() const { return double(usage_.ru_maxrss) / 1024; }

private:
    pid_t process_;
    struct rusage usage_;
};

//! A folder that is removed with everything in it at the end.
class TemporaryFolder
{
public:
    TemporaryFolder();
    ~TemporaryFolder();
    //! The path of a name in the folder.
    std::string operator/(const std::string& name) const { return path_ + "/" + name; }
    const std::string& path() const { return path_; }

private:
    std::string path_;
};

//! Mean absolute difference of two pictures away from their borders, which the other one may not show.
double differenceInside(const cv::Mat& a, const cv::Mat& b);

//! The names in a folder, hidden ones too, sorted.
std::vector<std::string> namesIn(const std::string& folder);
std::string contentOf(const std::string& path);
void writeContent(const std::string& path, const std::string& content);
std::vector<std::string> linesOf(const std::string& path);
//! A file without its last bytes.
void cutShort(const std::string& from, const std::string& to, double share);

//! A rolling-shutter image of a street with its truth and camera file, rendered once for all tests.
const std::string& streetFolder();
cv::Mat streetImage();

} // namespace opencv_test

#endif // RSACKERMANN_TEST_SAMPLES_PROGRAM_HPP
