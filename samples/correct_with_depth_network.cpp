// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Undoes the rolling shutter of images with the depth that a network sees in them: an ONNX file, run by OpenCV.

#include "camera_settings.hpp"
#include "correct/inputs.hpp"
#include "motion_words.hpp"
#include "network/depth_network.hpp"
#include "output/image_file.hpp"
#include "output/output_plan.hpp"
#include "output/result_names.hpp"
#include "estimator_options.hpp"
#include "units.hpp"

#include "opencv2/rsackermann.hpp"

#include <iostream>

namespace {

using namespace rsackermann_samples;
using namespace cv::rsackermann;

const char* const ABOUT =
    "Undoes the rolling shutter of images with the depth that a network sees in them: an ONNX file, run by OpenCV.\n"
    "usage: correct_with_depth_network --model=FILE --output=FILE|FOLDER [--option=value]... [--] INPUT...\n"
    "INPUT is an image, a folder of images, a printf pattern of image names or @FILE with one name per line.\n"
    "Exit code: 0 all is done, 1 some inputs failed, 2 the command line isn't understood.\n";

const char* const KEYS =
    "{help       |        | print this message}"
    "{model      |        | ONNX file of the network, with one input and one output}"
    "{depth_kind | relative | what the output is: relative (inverse depth, larger where it is nearer, of unknown scale "
    "and shift) or metric (metres along the optical axis)}"
    "{output     |        | corrected image; a folder, made if missing, if there are several inputs}"
    "{depth_output |      | what the network has said, as TIFF, for --depth of rsackermann_correct; a folder as for "
    "--output}"
    "{overwrite  |        | replace existing files}"
    "{wall       |        | metres to the left wall, or the only one seen; makes the speed metric}";

struct Task
{
    InputList inputs;
    CameraSettings camera;
    RollingShutterCorrector::Params params;
    MotionPrior prior;
    DepthKind kind;
    std::string output, depth;
    bool overwrite;

    std::string outputOf(const std::string& input) const
    {
        return resultPath(output, isResultFolder(output, inputs.single, "output"), fileName(input));
    }
    std::string depthOf(const std::string& input) const
    {
        return resultPath(depth, isResultFolder(depth, inputs.single, "depth_output"), stem(input) + ".tiff");
    }
};

Task readTask(const Options& options)
{
    for (const char* name : {"model", "output"})
        if (!options.given(name))
            throw UsageError(std::string("--") + name + " is missing");
    if (options.arguments().empty())
        throw UsageError("there is no input");
    Task task;
    task.camera = readCameraOptions(options);
    task.prior = readPriorOptions(options);
    if (options.given("wall"))
        task.params.estimator.wallDistance = options.positive("wall", 1e5);
    task.kind = options.choice("depth_kind", {"relative", "metric"}) == 0 ? DEPTH_RELATIVE : DEPTH_METRIC;
    task.output = options.outputFile("output");
    task.depth = options.given("depth_output") ? options.outputFile("depth_output") : "";
    task.overwrite = options.flag("overwrite");
    task.inputs = listInputs(options.arguments());
    for (const std::string& warning : task.inputs.warnings)
        std::cerr << "correct_with_depth_network: " << warning << std::endl;
    OutputPlan plan;
    options.inputFile("model");
    plan.addInputs(options.inputFiles());
    plan.addInputs(filesOf(task.inputs));
    for (const Input& input : task.inputs.inputs)
        for (const std::string& result : {task.outputOf(input.name), task.depthOf(input.name)})
            if (input.isFile() && !result.empty())
                plan.addOutput(result, input.name);
    plan.removeLeftovers();
    return task;
}

std::string useOf(const RollingShutterCorrector& corrector, const AckermannMotion& motion, int kind)
{
    const DepthMap used = corrector.getUsedDepth();
    if (!used.empty() && kind == DEPTH_RELATIVE)
        return cv::format("depth used: inverse depth %g * output %+g", used.scale, used.shift);
    if (!used.empty())
        return "depth used";
    return std::string("depth not used: ") +
           (motion.status != MOTION_OK ? "there is no motion to correct"
            : kind == DEPTH_RELATIVE
                ? "it contradicts the image, or doesn't show that it is its own"
                : "the speed in metres is unknown (--speed, --wall), or it is in another unit than walls and road");
}

void print(const std::string& input, const RollingShutterCorrector& corrector, const AckermannMotion& motion,
           const DepthMap& depth)
{
    double yawRate = 0, low = 0, high = 0;
    cv::minMaxIdx(depth.values, &low, &high);
    std::cout << input << ": " << STATUS_WORDS[size_t(motion.status)];
    if (motion.yawRate(corrector.getCamera(), yawRate))
        std::cout << cv::format(", %.1f deg/s", yawRate / DEGREE);
    std::cout << cv::format("; output %g to %g; ", low, high) << useOf(corrector, motion, depth.kind) << std::endl;
}

void correctImage(const Task& task, const std::string& input, DepthNetwork& network)
{
    const std::string output = task.outputOf(input), depthOutput = task.depthOf(input);
    checkResult(output, task.overwrite);
    checkResult(depthOutput, task.overwrite);
    ImageMetadata metadata;
    const cv::Mat image = readImage(input, &metadata);
    const cv::Ptr<RollingShutterCorrector> corrector =
        RollingShutterCorrector::create(task.camera.makeCamera(image.size()), task.params);
    corrector->setPrior(task.prior);

    const DepthMap depth(network.run(image), DEPTH_RAW, 1, task.kind);
    cv::Mat corrected;
    const AckermannMotion motion = corrector->correct(image, corrected, cv::noArray(), depth);

    AtomicFiles files;
    writeImage(files.add(output), corrected, metadata);
    if (!depthOutput.empty())
        writeImage(files.add(depthOutput), depth.values, {});
    files.commit();
    print(input, *corrector, motion, depth);
}

int run(const Options& options)
{
    const Task task = readTask(options);
    DepthNetwork network(options.inputFile("model"), readNetworkInput(options));
    int failures = 0;
    for (const Input& input : task.inputs.inputs)
        try
        {
            if (!input.isFile())
                throw InputError(input.error);
            correctImage(task, input.name, network);
        }
        catch (const std::exception& e)
        {
            failures++;
            std::cerr << "correct_with_depth_network: " << input.name << ": " << e.what() << std::endl;
        }
    return failures ? 1 : 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, std::string(KEYS) + NETWORK_KEYS + PRIOR_KEYS + CAMERA_KEYS, run, argc, argv);
}
