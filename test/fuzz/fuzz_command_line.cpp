// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "folder.hpp"
#include "values.hpp"

#include "estimator_options.hpp"
#include "job.hpp"
#include "options.hpp"

#include <algorithm>
#include <sstream>

// Command lines of rsackermann_correct, an argument a line. Only the empty folder, and one image in it, can be reached.

using namespace rsackermann_samples;

namespace {

// Whether a file elsewhere might be meant.
bool leavesFolder(const std::string& argument)
{
    return argument.find("..") != std::string::npos ||
           (argument.find('/') != std::string::npos && argument.compare(0, 8, "--shard=") != 0);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    static const fuzz::Folder folder;
    static const std::string keys = std::string(CAMERA_KEYS) + DETECTOR_KEY + PRIOR_KEYS + JOB_KEYS;
    if (size > 1000)
        return 0;
    std::istringstream text(std::string(reinterpret_cast<const char*>(data), size));
    std::vector<std::string> arguments(1, "rsackermann_correct");
    for (std::string argument; std::getline(text, argument);)
        arguments.push_back(argument.c_str()); // no argument has a zero
    if (std::any_of(arguments.begin(), arguments.end(), leavesFolder))
        return 0;
    std::vector<const char*> argv;
    for (const std::string& argument : arguments)
        argv.push_back(argument.c_str());
    folder.write("a.png", "");
    try
    {
        const Options options(int(argv.size()), argv.data(), keys);
        const Job job = readJob(options);
        job.params.check();
        job.prior.check();
    }
    catch (const UsageError&)
    {
    }
    catch (const InputError&)
    {
    }
    folder.clear();
    return 0;
}
