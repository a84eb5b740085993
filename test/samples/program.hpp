// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_TEST_SAMPLES_PROGRAM_HPP
#define RSACKERMANN_TEST_SAMPLES_PROGRAM_HPP

#include "opencv2/ts.hpp"
#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/imgcodecs.hpp"
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// GoogleTest would take JSON for a container of JSON, without end.
namespace nlohmann {
inline void PrintTo(const json& value, std::ostream* stream) { *stream << value.dump(); }
inline void PrintTo(const ordered_json& value, std::ostream* stream) { *stream << value.dump(); }
} // namespace nlohmann

namespace opencv_test {

typedef std::vector<std::string> Arguments;

//! What a program has done.
struct Outcome
{
    int exitCode; //!< -1 where it was ended by a signal
    std::string output, messages;
};

Outcome runProgram(const std::string& program, const Arguments& arguments);
inline Outcome correct(const Arguments& arguments) { return runProgram(CORRECT_PROGRAM, arguments); }
inline Outcome simulate(const Arguments& arguments) { return runProgram(SIMULATE_PROGRAM, arguments); }
inline Outcome evaluate(const Arguments& arguments) { return runProgram(EVALUATE_PROGRAM, arguments); }

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
