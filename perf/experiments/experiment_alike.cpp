// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "drive.hpp"
#include "map_distance.hpp"
#include "options.hpp"

#include "opencv2/imgcodecs.hpp"
#include "opencv2/imgproc.hpp"
#include <cstdio>

using namespace cv::rsackermann;
using namespace experiments;
using namespace rsackermann_samples;

namespace {

const char* const ABOUT =
    "Measures how far the corrections of images that are nearly alike differ: a frame of a real drive, and the same with\n"
    "a grey level of noise, at half the JPEG quality, and a pixel to the right.\n"
    "usage: rsackermann_experiment_alike FOLDER... [--option=value]...\n"
    "FOLDER has consecutive frames and frames.csv (calibration, time to the next frame, speed and yaw rate).\n";

const char* const KEYS = "{help       |        | print this message}"
                         "{given      | none   | what the estimator is given: none, yaw_rate, speed or both}"
                         "{every      | 4      | take every N-th frame}"
                         "{quiet      |        | print the summary only}"
                         "{threads    |        | number of threads}";

cv::Mat withNoise(const cv::Mat& image)
{
    cv::Mat noise(image.size(), CV_MAKETYPE(CV_16S, image.channels())), result;
    cv::RNG rng(1);
    rng.fill(noise, cv::RNG::NORMAL, 0, 1);
    image.convertTo(result, noise.type());
    result += noise;
    result.convertTo(result, image.type());
    return result;
}

cv::Mat atHalfQuality(const cv::Mat& image)
{
    std::vector<uchar> file;
    cv::imencode(".jpg", image, file, {cv::IMWRITE_JPEG_QUALITY, 47});
    return cv::imdecode(file, cv::IMREAD_COLOR);
}

cv::Mat aPixelToTheRight(const cv::Mat& image)
{
    cv::Mat result;
    cv::copyMakeBorder(image.colRange(0, image.cols - 1), result, 0, 0, 1, 0, cv::BORDER_REPLICATE);
    return result;
}

struct Correction
{
    cv::Mat columns, rows;
    double size; // mean displacement, pixels
};

Correction correctionOf(const cv::Mat& image, const DriveFrame& frame, int given)
{
    Correction c;
    const AckermannMotion motion = AckermannEstimator::create(frame.camera)
                                       ->estimateFromImage(image, cv::noArray(), cv::noArray(), priorOf(frame, given));
    WarpMapGenerator::create(frame.camera)->initRectifyMap(motion, c.columns, c.rows);
    cv::Mat identity[2];
    identityMaps(image.size(), identity[0], identity[1]);
    c.size = meanDistance(c.columns, c.rows, identity[0], identity[1], placesOf(c.columns, c.rows));
    return c;
}

struct Pair
{
    double size[2], difference; // pixels
    bool differs() const { return difference > std::max(0.3 * std::max(size[0], size[1]), 0.5); }
};

Pair compare(const Correction& a, const Correction& b)
{
    return {{a.size, b.size}, meanDistance(a.columns, a.rows, b.columns, b.rows, placesOf(a.columns, a.rows))};
}

std::vector<Pair> pairsOf(const DriveFrame& frame, int given)
{
    const cv::Mat image = cv::imread(frame.file);
    if (image.empty())
        throw InputError(frame.file + " can't be read");
    const Correction correction = correctionOf(image, frame, given);
    std::vector<Pair> pairs;
    for (const cv::Mat& other : {withNoise(image), atHalfQuality(image), aPixelToTheRight(image)})
        pairs.push_back(compare(correction, correctionOf(other, frame, given)));
    return pairs;
}

int run(const Options& options)
{
    if (options.given("threads"))
        cv::setNumThreads(options.integer("threads", 1, 1024));
    const int given = options.choice("given", {"none", "yaw_rate", "speed", "both"}),
              every = options.integer("every", 1, 1000000);
    std::vector<DriveFrame> frames;
    for (const std::string& folder : options.arguments())
    {
        const std::vector<DriveFrame> drive = readDrive(folder);
        for (size_t i = 0; i + 1 < drive.size(); i += every)
            frames.push_back(drive[i]);
    }
    std::vector<std::vector<Pair>> pairs(frames.size());
    cv::parallel_for_(
        cv::Range(0, int(frames.size())),
        [&](const cv::Range& range) {
            for (int i = range.start; i < range.end; i++)
                pairs[i] = pairsOf(frames[i], given);
        },
        double(frames.size()));
    int count = 0, differ = 0, oneIsNone = 0;
    for (size_t i = 0; i < frames.size(); i++)
        for (const Pair& pair : pairs[i])
        {
            count++;
            differ += pair.differs();
            oneIsNone += pair.differs() && std::min(pair.size[0], pair.size[1]) == 0;
            if (!options.flag("quiet"))
                std::printf("%-40s %6.2f %6.2f difference %6.2f%s\n",
                            frames[i].file.substr(std::max(int(frames[i].file.size()) - 40, 0)).c_str(), pair.size[0],
                            pair.size[1], pair.difference, pair.differs() ? " differs" : "");
        }
    std::printf("pairs %d differ %.1f %% of which one isn't corrected %d\n", count, 100. * differ / std::max(count, 1),
                oneIsNone);
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, KEYS, run, argc, argv);
}
