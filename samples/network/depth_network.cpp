// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "depth_network.hpp"
#include "files.hpp"
#include "picture.hpp"

#include "opencv2/imgproc.hpp"

namespace rsackermann_samples {

const char* const NETWORK_KEYS =
    "{network    | midas_small | whose input it has, the defaults of the options below: midas_small, midas, dpt or "
    "depth_anything}"
    "{input_size |        | WIDTHxHEIGHT of the network's input, to which images are scaled}"
    "{mean       |        | subtracted from the values (0 to 255) of red, green and blue: one number, or R,G,B}"
    "{scale      |        | multiplies the difference: one number, or R,G,B}"
    "{bgr        |        | the network takes blue first, not red}";

namespace {

// The exporter of MiDaS has the network normalise its input.
const char* const NETWORKS[] = {"midas_small", "midas", "dpt", "depth_anything"};
const int SIZES[] = {256, 384, 384, 518};
const cv::Vec3d MEANS[] = {{0, 0, 0}, {0, 0, 0}, {127.5, 127.5, 127.5}, {123.675, 116.28, 103.53}};
const cv::Vec3d DEVIATIONS[] = {{255, 255, 255}, {255, 255, 255}, {127.5, 127.5, 127.5}, {58.395, 57.12, 57.375}};

void readColour(const Options& options, const std::string& name, cv::Vec3d& value)
{
    if (!options.given(name))
        return;
    const std::vector<double> numbers = options.numbers(name);
    if (numbers.size() != 1 && numbers.size() != 3)
        throw UsageError("option --" + name + " has one number, or three");
    for (size_t i = 0; i < 3; i++)
        value[int(i)] = numbers[numbers.size() == 1 ? 0 : i];
}

// Of all dimensions only the last two may be more than 1.
bool isPicture(const cv::Mat& output)
{
    const int d = output.dims;
    return d >= 2 && output.type() == CV_32F && output.size[d - 1] > 1 && output.size[d - 2] > 1 &&
           output.total() == size_t(output.size[d - 1]) * size_t(output.size[d - 2]);
}

std::string shapeOf(const cv::Mat& output)
{
    std::string text = "(";
    for (int i = 0; i < output.dims; i++)
        text += (i ? ", " : "") + std::to_string(output.size[i]);
    return text + ")";
}

// Messages of OpenCV may end with a new line.
std::string reasonOf(const cv::Exception& e)
{
    return e.err.substr(0, e.err.find_last_not_of(" \n") + 1);
}

cv::dnn::Net readNetwork(const std::string& path)
{
    const std::vector<uchar> bytes = readBytes(path);
    cv::dnn::Net net;
    try
    {
        net = cv::dnn::readNetFromONNX(bytes);
    }
    catch (const cv::Exception& e)
    {
        throw InputError("OpenCV " CV_VERSION " can't read it as a network in ONNX: " + reasonOf(e));
    }
    const std::vector<std::string> outputs = net.getUnconnectedOutLayersNames();
    if (outputs.size() != 1)
        throw InputError(cv::format("the network has %zu outputs; one is expected", outputs.size()));
    return net;
}

} // namespace

NetworkInput readNetworkInput(const Options& options)
{
    const int network = options.choice("network", std::vector<std::string>(std::begin(NETWORKS), std::end(NETWORKS)));
    NetworkInput input;
    input.size = cv::Size(SIZES[network], SIZES[network]);
    if (options.given("input_size"))
        input.size = parseSize(options.text("input_size"), "option --input_size", 2, 8192);
    input.mean = MEANS[network];
    cv::divide(1, DEVIATIONS[network], input.scale);
    readColour(options, "mean", input.mean);
    readColour(options, "scale", input.scale);
    input.isBgr = options.flag("bgr");
    return input;
}

DepthNetwork::DepthNetwork(const std::string& path, const NetworkInput& input)
    : path_(path), input_(input), net_(namingFile(path, readNetwork))
{
}

cv::Mat1f DepthNetwork::run(const cv::Mat& image)
{
    cv::Mat scaled;
    cv::resize(pictureOf(image), scaled, input_.size, 0, 0, cv::INTER_AREA);
    cv::Mat3f values;
    scaled.convertTo(values, CV_32F);
    values.forEach([&](cv::Vec3f& value, const int*) {
        for (int i = 0; i < 3; i++)
            value[i] = float((value[i] - input_.mean[2 - i]) * input_.scale[2 - i]);
    });
    cv::Mat output;
    try
    {
        net_.setInput(cv::dnn::blobFromImage(values, 1, cv::Size(), cv::Scalar(), !input_.isBgr));
        output = net_.forward();
    }
    catch (const cv::Exception& e)
    {
        throw InputError(cv::format("%s: the network doesn't run on one input of shape (1, 3, %d, %d): %s",
                                    path_.c_str(), input_.size.height, input_.size.width, reasonOf(e).c_str()));
    }
    if (!isPicture(output))
        throw InputError(path_ + ": the output of shape " + shapeOf(output) +
                         " isn't a depth; one number for each pixel is expected");
    const int d = output.dims;
    const cv::Mat picture(output.size[d - 2], output.size[d - 1], CV_32F, output.data);
    cv::Mat1f depth;
    cv::resize(picture, depth, image.size());
    return depth;
}

} // namespace rsackermann_samples
