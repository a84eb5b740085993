// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "job.hpp"
#include "files.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include <map>

namespace rsackermann_samples {

using namespace cv::rsackermann;

const char* const JOB_KEYS =
    "{help       |        | print this message}"
    "{wall       |        | metres to the left (or only) wall; makes the speed metric}"
    "{gravity_sigma |     | standard deviation of --roll and --pitch in degrees, 0: exact (default 0.2)}"
    "{model      | auto   | motion model: auto, 4la, 3la, 1la or none}"
    "{detector   | lsd    | line segment detector: lsd, fld or edlines}"
    "{lines      |        | text file with line segments x1 y1 x2 y2, a line each, instead of a detector; for one input}"
    "{seed       | 0      | of the random numbers}"
    "{threads    |        | largest number of threads}"
    "{output     |        | corrected image; a folder, made if missing, where there are several inputs}"
    "{overlay    |        | picture of the segments and the road's borders; a folder as for --output}"
    "{report     |        | file with a line of JSON for each frame; - for standard output}"
    "{maps       |        | FileStorage file with the maps for cv::remap (map1, map2); for one input}"
    "{shard      |        | i/N: do every N-th input only, beginning with the i-th (1 to N)}"
    "{skip_existing |     | leave out inputs whose result exists; the report is continued}"
    "{overwrite  |        | replace existing files}";

namespace {

void readEstimator(const Options& options, AckermannEstimator::Params& params)
{
    static const int models[] = {MODEL_AUTO, MODEL_4LA, MODEL_3LA, MODEL_1LA, MODEL_NONE};
    params.model = models[options.choice("model", {"auto", "4la", "3la", "1la", "none"})];
    params.detector = options.choice("detector", {"lsd", "fld", "edlines"});
    params.seed = options.integer("seed", 0, INT_MAX);
    if (options.given("gravity_sigma"))
        params.gravitySigma = options.number("gravity_sigma", 0, 45) * CV_PI / 180;
    if (options.given("wall"))
        params.wallDistance = options.number("wall", 0, 1e5, false);
}

std::string target(const Options& options, const std::string& name)
{
    return options.given(name) ? options.text(name) : "";
}

// A single image goes to a file, unless the name is that of a folder.
bool isFolder(const InputList& inputs, const std::string& path)
{
    return !path.empty() && (!inputs.single || path.back() == '/' || cv::utils::fs::isDirectory(path));
}

// Two inputs of the same name would have the same result.
void checkNames(const InputList& inputs)
{
    std::map<std::string, std::string> names;
    for (const std::string& input : inputs.images)
    {
        const std::string& other = names.insert(std::make_pair(fileName(input), input)).first->second;
        if (&other != &input && other != input)
            throw UsageError("the results of " + other + " and " + input + " would have the same name");
    }
}

// Every result needs a name of its own, and the report must not replace an input.
void checkTargets(const Job& job)
{
    const std::string targets[] = {job.output, job.overlay, job.maps, job.report};
    for (const std::string& a : targets)
        for (const std::string& b : targets)
            if (&a != &b && !a.empty() && a == b)
                throw UsageError("two results would have the name " + a);
    for (const std::string& input : job.inputs.images)
        if (isSameFile(job.report, input))
            throw UsageError("the report would replace the input " + input);
}

void readShard(const Options& options, InputList& inputs)
{
    const std::string text = options.text("shard"), source = "option --shard (i/N)";
    const size_t slash = text.find('/');
    if (slash == std::string::npos)
        throw UsageError(source + ": '" + text + "' has no slash");
    const int count = parseInteger(text.substr(slash + 1), source, 1, 1000000);
    // 0/N is the same as N/N, for those who count from 0.
    const int shard = parseInteger(text.substr(0, slash), source, 0, count);
    keepShard(inputs.images, shard + count - 1, count);
}

} // namespace

Job readJob(const Options& options)
{
    Job job;
    if (options.arguments().empty())
        throw UsageError("there is no input");
    job.camera = readCameraOptions(options);
    readEstimator(options, job.params.estimator);
    job.output = target(options, "output");
    job.overlay = target(options, "overlay");
    job.maps = target(options, "maps");
    job.report = target(options, "report");
    if (job.output.empty() && job.overlay.empty() && job.maps.empty() && job.report.empty())
        throw UsageError("nothing is asked for: give --output, --overlay, --report or --maps");
    job.skipExisting = options.flag("skip_existing");
    job.overwrite = options.flag("overwrite");
    if (job.skipExisting && job.overwrite)
        throw UsageError("--skip_existing and --overwrite exclude each other");
    if (job.skipExisting && job.output.empty() && job.overlay.empty())
        throw UsageError("--skip_existing needs --output or --overlay");
    if (options.given("threads"))
        cv::setNumThreads(options.integer("threads", 1, 4096));

    job.inputs = listInputs(options.arguments());
    const bool one = job.inputs.images.size() + job.inputs.failures.size() == 1;
    job.linesGiven = options.given("lines");
    if ((job.linesGiven || !job.maps.empty()) && !one)
        throw UsageError(std::string(job.linesGiven ? "--lines" : "--maps") + " is for one input");
    if (job.linesGiven)
        job.lines = readSegments(options.text("lines"));
    job.outputIsFolder = isFolder(job.inputs, job.output);
    job.overlayIsFolder = isFolder(job.inputs, job.overlay);
    checkNames(job.inputs);
    checkTargets(job);
    if (options.given("shard"))
        readShard(options, job.inputs);
    return job;
}

std::string resultPath(const std::string& target, bool isFolder, const std::string& input)
{
    if (!isFolder)
        return target;
    return target + (target.back() == '/' ? "" : "/") + fileName(input);
}

} // namespace rsackermann_samples
