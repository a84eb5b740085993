// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "job.hpp"
#include "estimator_options.hpp"
#include "log_use.hpp"
#include "files.hpp"
#include "output/result_names.hpp"
#include "targets.hpp"
#include "units.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/imgcodecs.hpp"
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

namespace rsackermann_samples {

using namespace cv::rsackermann;

const char* const JOB_KEYS =
    "{help       |        | print this message}"
    "{wall       |        | metres to the left wall, or the only one seen; makes the speed metric}"
    "{scale_from_road |   | without --wall: estimate its distance from --height and wall segments that stand on the road}"
    "{log        |        | CSV file with values for each frame (columns file, frame, time_s, speed_kmh, "
    "speed_sigma_kmh, yaw_rate_deg_s, yaw_rate_sigma_deg_s, roll_deg, pitch_deg, gravity_sigma_deg); it overrides "
    "the options}"
    "{depth      |        | depth of the images: a file, a folder with files of the images' names (of a video with "
    "NAME_NNNNNN for each frame), or a printf pattern with as many files as images; PNG of 16 bits, TIFF, EXR or .npy, "
    "or points in a table (.csv)}"
    "{depth_kind | metric | metric, disparity, which needs --baseline, or relative: inverse depth, larger where it is "
    "nearer, of unknown scale and shift}"
    "{depth_camera | raw  | camera of --depth: raw, or corrected (without lens, at the reference line)}"
    "{depth_scale |       | metres or pixels per unit of --depth (default 1; of whole numbers 0.001 m, 1/256 px)}"
    "{depth_scale_sigma | | standard deviation of these metres, relative, 0: exact (default 0.1)}"
    "{baseline   |        | metres between the cameras that the disparity comes from}"
    "{carry      |        | treat the inputs, or the frames of each video, as one sequence; needs the line delay}"
    "{smooth     |        | --carry, and each frame also uses the one after it}"
    "{gravity_sigma |     | standard deviation of --roll and --pitch in degrees, 0: exact (default: of the vehicle's "
    "roll 1, of its pitch 0.3, and of a mount that isn't given 2 and 5)}"
    "{usual_yaw_rate |    | deg/s, scale of the prior on the yaw rate if none is given (default 5, as cars turn)}"
    "{model      | auto   | motion model: auto, 4la, 3la, 1la or none; not with --carry}"
    "{lines      |        | text file with line segments x1 y1 x2 y2, a line each, instead of a detector; for one "
    "image}"
    "{seed       | 0      | seed of the random numbers; no effect on frames that --carry tracks}"
    "{threads    |        | maximum number of threads}"
    "{output     |        | corrected image or video; a folder, made if missing, if there are several inputs}"
    "{overlay    |        | picture of the segments, the road's borders and what is expected; a folder as for --output}"
    "{report     |        | file with a line of JSON for each image or frame; - for standard output}"
    "{maps       |        | FileStorage file with the maps for cv::remap (map1, map2); several inputs: a folder as "
    "for --output with NAME.yml.gz, for a video with NAME_NNNNNN.yml.gz for each frame}"
    "{shard      |        | i/N: process only every N-th input, beginning with the i-th (1 to N)}"
    "{skip_existing |     | skip results that exist, and inputs whose results and lines of the report all exist}"
    "{overwrite  |        | replace existing files}";

namespace {

void readEstimator(const Options& options, AckermannEstimator::Params& params)
{
    params.model = readModel(options);
    params.detector = readDetector(options);
    params.seed = options.integer("seed", 0, INT_MAX);
    if (options.given("wall"))
        params.wallDistance = options.positive("wall", 1e5);
    if (options.given("usual_yaw_rate"))
        params.priorYawRate = options.positive("usual_yaw_rate", 1e4) * DEGREE;
    params.scaleFromRoad = options.flag("scale_from_road");
}

void warnUseless(const std::string& what, const std::string& missing)
{
    std::cerr << "rsackermann_correct: " << what << " has no effect without " << missing << std::endl;
}

MotionPrior readPrior(const Options& options, const Job& job)
{
    const MotionPrior prior = readPriorOptions(options);
    const bool readsRows = job.camera.scan == SCAN_TOP_TO_BOTTOM || job.camera.scan == SCAN_BOTTOM_TO_TOP,
               metric = readsRows && job.camera.hasLineDelay();
    const std::string delay = readsRows ? "the line delay (--line_delay, --readout or in the camera file)"
                                        : "a sensor that reads rows (--scan)";
    if (job.params.sequence && !metric)
        warnUseless(job.smooth ? "--smooth" : "--carry", delay);
    if (!job.gyro.times.empty() && !metric)
        warnUseless("--gyro", delay);
    if (options.given("depth") && !readsRows)
        warnUseless("--depth", delay);
    if (options.given("speed") && !metric)
        warnUseless("--speed", delay);
    if (options.given("yaw_rate") && !metric)
        warnUseless("--yaw_rate", delay);
    if (job.log.hasSpeed() && !metric)
        warnUseless("speed_kmh in the log", delay);
    if (job.log.hasYawRate() && !metric)
        warnUseless("yaw_rate_deg_s in the log", delay);
    return prior;
}

void checkScale(const Job& job)
{
    const AckermannEstimator::Params& params = job.params.estimator;
    if (params.scaleFromRoad && params.wallDistance > 0)
        throw UsageError("--scale_from_road and --wall exclude each other");
    if (params.scaleFromRoad && !(job.camera.height > 0))
        warnUseless("--scale_from_road", "--height");
}

std::string target(const Options& options, const std::string& name)
{
    return options.given(name) ? options.outputFile(name) : "";
}

// Of a picture that is the result of the only input; those in folders are called as the inputs are.
void checkPictureName(const std::string& option, const std::string& path, bool isFolder, const InputList& inputs)
{
    if (!path.empty() && !isFolder && !isVideo(inputs.inputs[0].name) && !cv::haveImageWriter(path))
        throw UsageError("option --" + option + ": " + path +
                         " has no extension of an image format that can be written (that of a folder ends with /)");
}

bool hasVideo(const InputList& inputs)
{
    return std::any_of(inputs.inputs.begin(), inputs.inputs.end(),
                       [](const Input& input) { return input.isFile() && isVideo(input.name); });
}

// All files are known before any work is done, those of other shards too.
void checkTargets(const Options& options, const Job& job)
{
    OutputPlan plan;
    plan.addInputs(options.inputFiles());
    plan.addInputs(filesOf(job.inputs));
    plan.addInputs(job.depth.files());
    for (const bool video : {true, false}) // the names of frames first
        for (const Input& input : job.inputs.inputs)
            if (input.isFile() && isVideo(input.name) == video)
                Targets(job, input.name).addTo(plan);
    if (!job.report.empty() && job.report != "-")
        plan.addOutput(job.report, "the report");
    plan.removeLeftovers();
}

void checkVideos(const Job& job)
{
    if (!hasVideo(job.inputs))
        return;
#ifndef RSACKERMANN_WITH_VIDEOIO
    throw UsageError("videos are not read, since OpenCV's module videoio was missing when this program was built");
#endif
    if (job.linesGiven)
        throw UsageError("--lines is for an image");
}

void readShard(const Options& options, Job& job)
{
    job.shardCount = 1;
    if (!options.given("shard"))
        return;
    if (job.params.sequence)
        throw UsageError("--carry and --shard exclude each other: the frames of a shard aren't consecutive");
    const std::string text = options.text("shard"), source = "option --shard (i/N)";
    const size_t slash = text.find('/');
    if (slash == std::string::npos)
        throw UsageError(source + ": '" + text + "' has no slash");
    const int count = parseInteger(text.substr(slash + 1), source, 1, 1000000);
    job.shardCount = count;
    keepShard(job.inputs, parseInteger(text.substr(0, slash), source, 1, count), count);
}

} // namespace

Job readJob(const Options& options)
{
    Job job;
    if (options.arguments().empty())
        throw UsageError("there is no input");
    job.camera = readCameraOptions(options);
    readEstimator(options, job.params.estimator);
    job.gravitySigma = options.given("gravity_sigma") ? options.number("gravity_sigma", 0, 45)
                                                      : std::numeric_limits<double>::quiet_NaN();
    checkScale(job);
    if (options.given("log"))
        job.log = DriveLog(options.inputFile("log"));
    job.gyro = readGyroOptions(options, "rsackermann_correct");
    job.smooth = options.flag("smooth");
    job.params.sequence = job.smooth || options.flag("carry");
    if (job.params.sequence && job.params.estimator.model != MODEL_AUTO)
        throw UsageError("--model and --carry exclude each other: tracked points determine the whole motion");
    job.prior = readPrior(options, job);
    job.output = target(options, "output");
    job.overlay = target(options, "overlay");
    job.maps = target(options, "maps");
    job.report = options.given("report") ? options.text("report") : ""; // - is standard output
    if (job.output.empty() && job.overlay.empty() && job.maps.empty() && job.report.empty())
        throw UsageError("nothing to do: give --output, --overlay, --report or --maps");
    job.skipExisting = options.flag("skip_existing");
    job.overwrite = options.flag("overwrite");
    if (job.skipExisting && job.overwrite)
        throw UsageError("--skip_existing and --overwrite exclude each other");
    if (job.skipExisting && job.output.empty() && job.overlay.empty() && job.maps.empty() && job.report == "-")
        throw UsageError("--skip_existing needs a file: --output, --overlay, --maps or --report");
    setThreads(options);

    job.inputs = listInputs(options.arguments());
    for (const std::string& warning : job.inputs.warnings)
        std::cerr << "rsackermann_correct: " << warning << std::endl;
    job.linesGiven = options.given("lines");
    if (job.linesGiven && job.inputs.inputs.size() != 1)
        throw UsageError("--lines is for one input");
    if (job.linesGiven && options.given("detector"))
        throw UsageError("--lines and --detector exclude each other");
    checkVideos(job);
    job.depth = DepthSource(options, job.inputs);
    if (job.linesGiven)
        job.lines = readSegments(options.inputFile("lines"));
    job.outputIsFolder = isResultFolder(job.output, job.inputs.single, "output");
    job.overlayIsFolder = isResultFolder(job.overlay, job.inputs.single, "overlay");
    job.mapsIsFolder = isResultFolder(job.maps, job.inputs.single && !hasVideo(job.inputs), "maps");
    if (options.given("log"))
        checkLog(job.log, job.inputs, "rsackermann_correct");
    checkGyro(job.gyro, job.log, job.inputs);
    checkTargets(options, job);
    checkPictureName("output", job.output, job.outputIsFolder, job.inputs);
    checkPictureName("overlay", job.overlay, job.overlayIsFolder, job.inputs);
    readShard(options, job);
    return job;
}

void setGravitySigma(double degrees, RollingShutterCamera& camera, AckermannEstimator::Params& params)
{
    if (std::isnan(degrees))
        return;
    camera.rollSigma = camera.pitchSigma = 0;
    params.gravitySigma = degrees * DEGREE;
    if (params.gravitySigma > 0)
        params.vehiclePitchSigma = params.gravitySigma;
}

} // namespace rsackermann_samples
