// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "experiment.hpp"
#include "options.hpp"
#include "table.hpp"

#include "opencv2/core/optim.hpp"
#include "opencv2/imgcodecs.hpp"
#include "opencv2/imgproc.hpp"
#include "opencv2/rsackermann.hpp"
#include <cstdio>

using namespace cv::rsackermann;
using namespace experiments;
using namespace rsackermann_samples;

namespace {

const char* const ABOUT =
    "Compares corrected rolling-shutter frames with global-shutter images: PSNR in dB before, and what is gained by\n"
    "the estimated motion, by the motion that fits the global-shutter image best, and by that with roll and pitch\n"
    "fitted, too; then the number of candidates for verticals, and how many of them are vertical to half a pixel\n"
    "after the estimated and after the best motion.\n";

const char* const KEYS =
    "{help       |        | print this message}"
    "{frames     |        | folder with frames.csv (name,focal_px,roll_deg,pitch_deg,heading_deg) and, for each name, "
    "a folder with rolling.png and global_middle.png}"
    "{gravity_sigma |     | degrees, what the estimator is given of roll and pitch, in the place of its default}"
    "{threads    |        | number of threads}";

struct Frame
{
    std::string name;
    RollingShutterCamera camera;
    cv::Mat rolling, global;
};

cv::Mat readImage(const std::string& file)
{
    const cv::Mat image = cv::imread(file);
    if (image.empty())
        throw InputError(file + " can't be read");
    return image;
}

Frame readFrame(const std::string& folder, const std::vector<std::string>& row)
{
    const double degree = CV_PI / 180;
    double values[4];
    for (int i = 0; i < 4; i++)
        values[i] = parseNumber(row[i + 1], "frames.csv");
    Frame frame;
    frame.name = row[0];
    frame.rolling = readImage(folder + row[0] + "/rolling.png");
    frame.global = readImage(folder + row[0] + "/global_middle.png");
    if (frame.rolling.size() != frame.global.size())
        throw InputError(folder + row[0] + ": the two images differ in size");
    frame.camera = RollingShutterCamera::fromFocal(frame.rolling.size(), values[0]);
    frame.camera.setRollPitch(values[1] * degree, values[2] * degree);
    frame.camera.heading = values[3] * degree;
    return frame;
}

// PSNR of the correction by a motion; what it doesn't fill stays as it was, so that leaving out pixels doesn't pay.
double psnr(const Frame& frame, const WarpMapGenerator& generator, const AckermannMotion& motion)
{
    cv::Mat x, y, mask, corrected, result = frame.rolling.clone();
    generator.initRectifyMap(motion, x, y, CV_32FC1, mask);
    cv::remap(frame.rolling, corrected, x, y, cv::INTER_LINEAR);
    corrected.copyTo(result, mask);
    return cv::PSNR(result, frame.global);
}

// PSNR to be maximised over alpha, B, D and, if wanted, roll and pitch, in steps that move pixels about equally.
class Misfit : public cv::MinProblemSolver::Function
{
public:
    Misfit(const Frame& frame_, const AckermannMotion& start_, bool fitGravity_)
        : frame(frame_), start(start_), fitGravity(fitGravity_), generator(WarpMapGenerator::create(frame_.camera))
    {
    }

    int getDims() const CV_OVERRIDE { return fitGravity ? 5 : 3; }

    double calc(const double* x) const CV_OVERRIDE { return -psnr(frame, *generator, at(x)); }

    cv::Mat1d steps() const { return row({0.005, 0.01, 0.01, 0.01, 0.01}); }

    cv::Mat1d first() const
    {
        return row({start.alpha, start.wallSlope, start.wallOffset, start.rollCorrection, start.pitchCorrection});
    }

    AckermannMotion at(const double* x) const
    {
        AckermannMotion m = start;
        m.status = MOTION_OK;
        m.model = MODEL_4LA;
        m.alpha = x[0];
        m.wallSlope = x[1];
        m.wallOffset = x[2];
        if (fitGravity)
        {
            m.rollCorrection = x[3];
            m.pitchCorrection = x[4];
        }
        // The wall is seen at the heading, to the side of which it lies.
        m.direction = m.wallOffset >= 0 ? 1 : -1;
        return m;
    }

private:
    cv::Mat1d row(const std::vector<double>& values) const
    {
        return cv::Mat(values, true).reshape(1, 1).colRange(0, getDims());
    }

    const Frame& frame;
    AckermannMotion start;
    bool fitGravity;
    cv::Ptr<WarpMapGenerator> generator;
};

Frame blurred(const Frame& frame, double sigma)
{
    cv::Mat rolling, global;
    cv::GaussianBlur(frame.rolling, rolling, cv::Size(), sigma);
    cv::GaussianBlur(frame.global, global, cv::Size(), sigma);
    Frame result = frame;
    result.rolling = rolling;
    result.global = global;
    return result;
}

// From coarse to fine, as the misfit of a sharp image has many minima.
AckermannMotion fitMotion(const Frame& frame, const AckermannMotion& start, bool fitGravity)
{
    AckermannMotion motion = start;
    for (double sigma : {8., 2., 0.})
    {
        const Frame image = sigma > 0 ? blurred(frame, sigma) : frame;
        const cv::Ptr<Misfit> misfit = cv::makePtr<Misfit>(image, motion, fitGravity);
        cv::Mat1d x = misfit->first();
        cv::DownhillSolver::create(misfit, misfit->steps(),
                                   cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 300, 1e-4))
            ->minimize(x);
        motion = misfit->at(x[0]);
    }
    return motion;
}

// Candidates whose corrected ends are in the same column of an upright camera, to half a pixel.
int countVerticals(const Frame& frame, const AckermannMotion& motion, const cv::Mat& candidates)
{
    if (candidates.empty())
        return 0;
    cv::Mat ends;
    WarpMapGenerator::create(frame.camera)->correctPoints(motion, candidates.reshape(1, 2 * candidates.rows), ends);
    const cv::Matx33d upright = frame.camera.uprightRotation * frame.camera.cameraMatrix.inv();
    std::vector<double> columns;
    for (int i = 0; i < ends.rows; i++)
    {
        const cv::Vec3d ray = upright * cv::Vec3d(ends.at<float>(i, 0), ends.at<float>(i, 1), 1);
        columns.push_back(frame.camera.cameraMatrix(0, 0) * ray[0] / ray[2]);
    }
    int count = 0;
    for (size_t i = 0; i < columns.size(); i += 2)
        count += std::abs(columns[i] - columns[i + 1]) < 0.5;
    return count;
}

// The segments that the estimator takes for images of verticals.
cv::Mat candidatesOf(const cv::Mat& segments, const cv::Mat& labels)
{
    cv::Mat candidates(0, 4, CV_32F);
    for (int i = 0; i < labels.rows; i++)
        if (labels.at<uchar>(i) != SEGMENT_REJECTED)
            candidates.push_back(segments.row(i));
    return candidates;
}

int run(const Options& options)
{
    if (!options.arguments().empty() || !options.given("frames"))
        throw UsageError("--frames=FOLDER is expected");
    if (options.given("threads"))
        cv::setNumThreads(options.integer("threads", 1, 1024));
    const std::string folder = options.text("frames") + "/";
    AckermannEstimator::Params params;
    if (options.given("gravity_sigma"))
        setGravitySigma(options.number("gravity_sigma", 0, 45) * CV_PI / 180, params);

    double sums[3] = {0, 0, 0};
    const std::vector<std::vector<std::string>> rows =
        readTable(folder + "frames.csv", {"name", "focal_px", "roll_deg", "pitch_deg", "heading_deg"});
    std::printf("frame\tbefore\testimated\tbest motion\tand gravity\tcandidates\testimated\tbest\n");
    for (const std::vector<std::string>& row : rows)
    {
        const Frame frame = readFrame(folder, row);
        const cv::Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(frame.camera);
        const double before = psnr(frame, *generator, AckermannMotion());
        cv::Mat segments, labels;
        const AckermannMotion estimated =
            AckermannEstimator::create(frame.camera, params)->estimateFromImage(frame.rolling, segments, labels);
        const cv::Mat candidates = candidatesOf(segments, labels);
        double gains[3] = {psnr(frame, *generator, estimated) - before, -DBL_MAX, -DBL_MAX};
        AckermannMotion best;
        for (int fitGravity = 0; fitGravity < 2; fitGravity++)
            for (const AckermannMotion& start : {estimated, AckermannMotion()})
            {
                const AckermannMotion fitted = fitMotion(frame, start, fitGravity > 0);
                const double gain = psnr(frame, *generator, fitted) - before;
                if (gain > gains[1 + fitGravity] && !fitGravity)
                    best = fitted;
                gains[1 + fitGravity] = std::max(gains[1 + fitGravity], gain);
            }
        std::printf("%s\t%.2f\t%+.2f\t%+.2f\t%+.2f\t%d\t%d\t%d\n", frame.name.c_str(), before, gains[0], gains[1],
                    gains[2], candidates.rows, countVerticals(frame, estimated, candidates),
                    countVerticals(frame, best, candidates));
        for (int i = 0; i < 3; i++)
            sums[i] += gains[i] / double(rows.size());
    }
    std::printf("mean\t\t%+.2f\t%+.2f\t%+.2f\n", sums[0], sums[1], sums[2]);
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, KEYS, run, argc, argv);
}
