// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "options.hpp"
#include "rendered_drive.hpp"
#include "street_model.hpp"
#include "units.hpp"

#include "opencv2/imgproc.hpp"
#include <iostream>
#include <random>

using namespace cv::rsackermann;
using namespace rsackermann_samples;

namespace {

const char* const ABOUT =
    "Measures maps with a given depth on rendered streets with staggered houses, cars, posts and trees. Speed, yaw rate\n"
    "and walls are given, or estimated with a depth (--relative, --metric). Prints means over all streets: displacement\n"
    "of the raw image and after the correction, in pixels that are seen, and the share of the pixels whose mask is\n"
    "right.\n";

const char* const KEYS =
    "{help       |         | print this message}"
    "{size       | 640x380 | of the images, pixels}"
    "{streets    | 20      | number of streets}"
    "{first      | 0       | number of the first of them}"
    "{obstacles  | 15      | cars, posts and trees on 100 m of each side}"
    "{stagger    | 1.5     | metres by which houses stand back}"
    "{speed      | 60      | km/h}"
    "{yaw_rate   | 40      | deg/s}"
    "{depth      | raw     | the camera whose depth is given: raw, corrected or none}"
    "{noise      | 0       | relative standard deviation of the depth's errors}"
    "{noise_size | 0       | pixels over which these are alike; 0: each pixel has its own}"
    "{hole       | 12      | size of holes in the depth, pixels; 0: single pixels}"
    "{holes      | 0       | share of the pixels without a depth}"
    "{relative   |         | whose relative depth is given, scale and shift unknown: own, mirrored, "
    "other (another street), later (5 m ahead) or constant}"
    "{metric     |         | the same for a depth in metres}"
    "{farther    | 1       | times as far as these are the metres of --metric}"
    "{scale_sigma|         | relative standard deviation of their scale}"
    "{given      | both    | of an estimate: both, the yaw rate to 1 deg/s and the speed to 2 km/h, "
    "yaw_rate or speed alone, or nothing}"
    "{gravity    | 0.3     | degrees, standard deviation of roll and pitch of an estimate}"
    "{frames     | 1       | of a drive, of which the last one has the depth; more than one are a sequence}"
    "{verbose    |         | a line for each street of estimates}"
    "{threads    |         | number of threads}";

//! Of whose depth.
const std::vector<std::string> CAMERAS = {"raw", "corrected", "none"};

//! Whose depth is given.
enum { OWN, MIRRORED, OTHER, LATER, CONSTANT };

struct Measured
{
    double raw, residual, sky; // pixels
    double worst;              // 99th percentile
    double right;              // share

    Measured() : raw(0), residual(0), sky(0), worst(0), right(0) {}
};

street::StreetCamera makeCamera(const cv::Size& size)
{
    return street::StreetCamera(size, 816. / 640 * size.width, 0.4 / 30 / size.height, 1.2);
}

street::StreetScene makeScene(const Options& options, unsigned seed)
{
    street::StreetScene scene;
    scene.seed = seed;
    scene.speed = options.number("speed", -500, 500) * KMH;
    scene.yawRate = options.number("yaw_rate", -360, 360) * DEGREE * (seed % 2 ? -1 : 1);
    scene.left = 3.2;
    scene.right = 4;
    scene.obstacles = options.number("obstacles", 0, 100);
    scene.stagger = options.number("stagger", 0, 10);
    return scene;
}

// The share of pixels with the largest values of smooth noise, or of noise without any size.
cv::Mat holesOf(const cv::Size& size, double share, double hole, cv::RNG& rng)
{
    cv::Mat1f noise(size);
    rng.fill(noise, cv::RNG::UNIFORM, 0, 1);
    if (hole > 0)
        cv::GaussianBlur(noise, noise, cv::Size(), hole / 2);
    cv::Mat1f sorted = noise.clone().reshape(1, 1);
    cv::sort(sorted, sorted, cv::SORT_EVERY_ROW + cv::SORT_DESCENDING);
    return noise > sorted(0, std::min(int(share * sorted.cols), sorted.cols - 1));
}

cv::Mat disturbed(const cv::Mat& truth, const Options& options, cv::RNG& rng)
{
    cv::Mat1f noise(truth.size());
    rng.fill(noise, cv::RNG::NORMAL, 0, 1);
    const double alike = options.number("noise_size", 0, 1000);
    if (alike > 0)
    {
        cv::GaussianBlur(noise, noise, cv::Size(), alike / 2);
        noise /= std::max(cv::norm(noise) / std::sqrt(double(noise.total())), DBL_MIN);
    }
    noise = 1 + options.number("noise", 0, 1) * noise;
    cv::Mat depth = truth.mul(noise);
    const double share = options.number("holes", 0, 1);
    if (share > 0)
        depth.setTo(NAN, holesOf(truth.size(), share, options.number("hole", 0, 1000), rng));
    return depth;
}

Measured measure(const street::StreetRenderer& renderer, const cv::Mat& columns, const cv::Mat& rows,
                 const cv::Mat& mask)
{
    cv::Mat trueColumns, trueRows, inside;
    renderer.rectifyMap(trueColumns, trueRows, inside);
    const cv::Mat1f depth = renderer.globalDepth();
    Measured sum;
    int seen = 0, right = 0, sky = 0;
    std::vector<double> errors;
    for (int y = 0; y < mask.rows; y++)
        for (int x = 0; x < mask.cols; x++)
        {
            const cv::Point2d p(x, y), truth(trueColumns.at<float>(y, x), trueRows.at<float>(y, x)),
                found(columns.at<float>(y, x), rows.at<float>(y, x));
            cv::Point2d back;
            const bool isInside = inside.at<uchar>(y, x) != 0;
            const bool isSeen = isInside && renderer.toGlobal(truth, back) && cv::norm(back - p) < 0.5;
            right += mask.at<uchar>(y, x) == (isSeen ? MASK_SEEN : isInside ? MASK_HIDDEN : MASK_OUTSIDE);
            if (!isSeen)
                continue;
            if (depth(y, x) == 0)
            {
                sum.sky += cv::norm(found - truth);
                sky++;
                continue;
            }
            sum.raw += cv::norm(p - truth);
            errors.push_back(cv::norm(found - truth));
            sum.residual += errors.back();
            seen++;
        }
    sum.raw /= seen;
    sum.residual /= seen;
    sum.sky /= std::max(sky, 1);
    const size_t rank = errors.size() * 99 / 100;
    std::nth_element(errors.begin(), errors.begin() + ptrdiff_t(rank), errors.end());
    sum.worst = errors[rank];
    sum.right = right / double(mask.total());
    return sum;
}

// The depth of a frame, in metres or as a network might give it.
DepthMap depthOf(const street::StreetCamera& camera, street::StreetScene scene, int whose, const Options& options,
                 cv::RNG& rng)
{
    if (whose == OTHER)
        scene.seed += 1000;
    else if (whose == LATER)
        scene.travelled += 5;
    const bool isRaw = options.choice("depth", CAMERAS) == DEPTH_RAW;
    const street::StreetRenderer renderer(camera, scene);
    const cv::Mat metres = disturbed(isRaw ? renderer.rollingDepth() : renderer.globalDepth(), options, rng);
    const double scale = std::exp(rng.gaussian(1)), shift = rng.gaussian(1);
    const bool inMetres = options.given("metric");
    cv::Mat1f values = metres.clone();
    for (int y = 0; y < values.rows && !inMetres; y++)
        for (int x = 0; x < values.cols; x++)
            values(y, x) = float(scale * (values(y, x) == 0 ? 0 : 1 / values(y, x)) + shift); // 0: the sky
    if (whose == MIRRORED)
        cv::flip(values, values, 1);
    else if (whose == CONSTANT)
        values.setTo(inMetres ? 10 : shift);
    DepthMap depth(values, isRaw ? DEPTH_RAW : DEPTH_CORRECTED, options.number("farther", 0.01, 100),
                   inMetres ? DEPTH_METRIC : DEPTH_RELATIVE);
    if (options.given("scale_sigma"))
        depth.scaleSigma = options.number("scale_sigma", 0, 1);
    return depth;
}

struct Estimated
{
    Measured with, without;
    double expected; // pixels left
    bool isUsed;
};

// Estimates the motion with and without the depth, which the last frame has.
Estimated estimate(const street::StreetCamera& streetCamera, const street::StreetScene& scene, int whose,
                   const Options& options, cv::RNG& rng)
{
    const double gravity = options.number("gravity", 0, 10) * DEGREE;
    RollingShutterCamera camera = libraryCamera(streetCamera);
    const double roll = rng.gaussian(gravity), pitch = rng.gaussian(gravity);
    camera.setRollPitch(streetCamera.roll + roll, streetCamera.pitch + pitch);
    const int given = options.choice("given", {"both", "yaw_rate", "speed", "nothing"});
    const double yawRateError = rng.gaussian(DEGREE), speedError = rng.gaussian(2 * KMH);
    const int frames = options.integer("frames", 1, 100);
    RollingShutterCorrector::Params params;
    params.estimator.gravitySigma = params.estimator.vehiclePitchSigma = gravity;
    params.sequence = frames > 1;
    const cv::Ptr<RollingShutterCorrector> correctors[] = {RollingShutterCorrector::create(camera, params),
                                                           RollingShutterCorrector::create(camera, params)};
    street::RenderedDrive drive(streetCamera, scene);
    drive.course = street::RenderedDrive::WEAVING;
    drive.phase = CV_PI / 2; // the yaw rate hardly changes
    Estimated found;
    for (int i = 0; i < frames; i++)
    {
        const street::StreetRenderer renderer = drive.next();
        const cv::Mat image = renderer.rollingShutter();
        const bool isLast = i + 1 == frames;
        DepthMap depth;
        if (isLast)
            depth = depthOf(streetCamera, drive.street(), whose, options, rng);
        MotionPrior prior;
        prior.yawRate = drive.yawRate() + yawRateError;
        prior.yawRateSigma = given == 0 || given == 1 ? DEGREE : 0;
        prior.speed = drive.speed() + speedError;
        prior.speedSigma = given == 0 || given == 2 ? 2 * KMH : 0;
        for (const bool isGiven : {false, true})
        {
            RollingShutterCorrector& corrector = *correctors[isGiven];
            cv::Mat corrected, mask, columns, rows;
            corrector.setPrior(prior);
            const AckermannMotion motion = corrector.correct(image, corrected, mask, isGiven ? depth : DepthMap());
            if (!isLast)
                continue;
            found.expected = motion.expectedResidual;
            corrector.getMaps(columns, rows);
            (isGiven ? found.with : found.without) = measure(renderer, columns, rows, mask);
            found.isUsed = corrector.isDepthUsed();
        }
    }
    return found;
}

int runEstimates(const Options& options, const cv::Size& size)
{
    const std::vector<std::string> names = {"own", "mirrored", "other", "later", "constant"};
    const int whose = options.choice(options.given("metric") ? "metric" : "relative", names),
              streets = options.integer("streets", 1, 10000);
    double raw = 0, with = 0, without = 0, expected = 0, left = 0, harm = 0; // expected, left: where it is used
    int used = 0;
    for (int i = 0; i < streets; i++)
    {
        const unsigned seed = unsigned(options.integer("first", 0, 1000000) + i);
        std::mt19937_64 generator(seed); // first numbers of a linear one would form a pattern over the streets
        cv::RNG rng(generator());
        const Estimated found = estimate(makeCamera(size), makeScene(options, seed), whose, options, rng);
        raw += found.with.raw / streets;
        with += found.with.residual / streets;
        without += found.without.residual / streets;
        harm = std::max(harm, found.with.residual / found.without.residual - 1);
        used += found.isUsed;
        expected += found.isUsed * found.expected;
        left += found.isUsed * found.with.residual;
        if (options.flag("verbose"))
            std::cout << cv::format("%u raw %.3f without %.3f with %.3f expected %.3f used %d\n", seed, found.with.raw,
                                    found.without.residual, found.with.residual, found.expected, found.isUsed);
    }
    std::cout << cv::format("raw %.3f px, residual %.3f px (%.3f), without the depth %.3f px (%.3f), used in %d of %d "
                            "(%.3f px expected, %.3f left), at worst %.1f %% more than without\n",
                            raw, with, with / raw, without, without / raw, used, streets, expected / std::max(used, 1),
                            left / std::max(used, 1), 100 * harm);
    return 0;
}

int run(const Options& options)
{
    options.refuseArguments();
    if (options.given("threads"))
        cv::setNumThreads(options.integer("threads", 1, 1024));
    const cv::Size size = parseSize(options.text("size"), "option --size", 16, 10000);
    if (options.given("relative") || options.given("metric"))
        return runEstimates(options, size);
    const int camera = options.choice("depth", CAMERAS), streets = options.integer("streets", 1, 10000);
    Measured mean;
    for (int i = 0; i < streets; i++)
    {
        const street::StreetCamera streetCamera = makeCamera(size);
        const unsigned seed = unsigned(options.integer("first", 0, 1000000) + i);
        const street::StreetScene scene = makeScene(options, seed);
        const street::StreetRenderer renderer(streetCamera, scene);
        cv::RNG rng(uint64_t(seed) + 1);
        DepthMap depth;
        if (camera != 2)
            depth = DepthMap(disturbed(camera == 0 ? renderer.rollingDepth() : renderer.globalDepth(), options, rng),
                             camera);
        cv::Mat columns, rows, mask;
        WarpMapGenerator::create(libraryCamera(streetCamera))
            ->initRectifyMap(libraryMotion(streetCamera, scene), columns, rows, CV_32FC1, mask, depth);
        const Measured m = measure(renderer, columns, rows, mask);
        mean.raw += m.raw / streets;
        mean.residual += m.residual / streets;
        mean.sky += m.sky / streets;
        mean.worst += m.worst / streets;
        mean.right += m.right / streets;
    }
    std::cout << cv::format("raw %.3f px, residual %.4f px (99 %%: %.3f px), of the sky %.4f px, mask right %.2f %%\n",
                            mean.raw, mean.residual, mean.worst, mean.sky, 100 * mean.right);
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, KEYS, run, argc, argv);
}
