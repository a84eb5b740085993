// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Bad arguments and values at every public entry: cv::Exception, or a result, and nothing else. Images have their own
// tests (test_image_arguments.hpp).

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_metric_motion.hpp"
#include "opencv2/rsackermann/calibration.hpp"
#include "opencv2/rsackermann/corrector.hpp"
#include "opencv2/rsackermann/draw.hpp"
#include <functional>
#include <regex>

namespace opencv_test { namespace {

const Size SIZE(61, 47);

RollingShutterCamera smallCamera()
{
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(SIZE, 50);
    camera.lineDelay = 1e-4;
    return camera;
}

Mat noise()
{
    Mat image(SIZE, CV_8U);
    RNG(3).fill(image, RNG::UNIFORM, 0, 256);
    return image;
}

Mat segmentsOf(int count)
{
    RNG rng(5);
    Mat segments(count, 1, CV_32FC4);
    for (int i = 0; i < count; i++)
    {
        const float x = rng.uniform(3.f, 57.f), y = rng.uniform(2.f, 20.f);
        segments.at<Vec4f>(i) = Vec4f(x, y, x + rng.uniform(-1.f, 1.f), y + 20);
    }
    return segments.reshape(1);
}

//! False if it throws cv::Exception; anything else that is thrown fails.
bool isAccepted(const std::function<void()>& call)
{
    try
    {
        call();
        return true;
    }
    catch (const cv::Exception& e)
    {
        EXPECT_FALSE(std::regex_search(e.err, std::regex("of type [0-9]"))) << e.err; // types have names
        EXPECT_EQ(Error::StsBadArg, e.code) << e.what();
        EXPECT_NE(std::string::npos, e.err.find("expected")) << e.what();
        return false;
    }
    catch (const std::exception& e)
    {
        ADD_FAILURE() << "another exception: " << e.what();
        return false;
    }
}

struct ArrayEntry
{
    const char* name;
    std::function<void(InputArray)> call;
};

std::vector<ArrayEntry> arrayEntries()
{
    const RollingShutterCamera camera = smallCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(camera);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const Ptr<AckermannEstimator> estimator = AckermannEstimator::create(camera);
    const Mat times = (Mat_<double>(3, 1) << 1, 2, 3), rates = Mat::zeros(3, 3, CV_64F);
    return {{"estimate", [=](InputArray a) { estimator->estimate(a); }},
            {"correctWithSegments",
             [=](InputArray a) {
                 Mat dst;
                 corrector->correctWithSegments(noise(), a, dst);
             }},
            {"addGyro, times",
             [=](InputArray a) {
                 corrector->clearGyro();
                 corrector->addGyro(a, rates);
             }},
            {"addGyro, rates",
             [=](InputArray a) {
                 corrector->clearGyro();
                 corrector->addGyro(times, a);
             }},
            {"addGyro of the calibrator",
             [=](InputArray a) {
                 calibrator->clearGyro();
                 calibrator->addGyro(times, a);
             }},
            {"addPoints, points", [=](InputArray a) { calibrator->addPoints(a, segmentsOf(3), 7); }},
            {"addPoints, segments", [=](InputArray a) { calibrator->addPoints(Mat(3, 4, CV_32F, Scalar(5)), a, 7); }},
            {"correctPoints",
             [=](InputArray a) {
                 Mat dst;
                 generator->correctPoints(exampleMotion(), a, dst);
             }},
            {"distortPoints",
             [=](InputArray a) {
                 Mat dst;
                 generator->distortPoints(exampleMotion(), a, dst);
             }},
            {"depths of points",
             [=](InputArray a) {
                 Mat dst;
                 generator->correctPoints(exampleMotion(), Mat(2, 1, CV_64FC2, Scalar(5, 6)), dst, a);
             }},
            {"drawMotion, segments",
             [=](InputArray a) {
                 Mat image(SIZE, CV_8UC3, Scalar());
                 drawMotion(image, a, noArray(), camera, exampleMotion());
             }},
            {"drawMotion, labels",
             [=](InputArray a) {
                 Mat image(SIZE, CV_8UC3, Scalar());
                 drawMotion(image, segmentsOf(3), a, camera, exampleMotion());
             }},
            {"DepthMap", [=](InputArray a) {
                 if (a.kind() == _InputArray::STD_VECTOR_MAT || a.kind() == _InputArray::STD_VECTOR_VECTOR)
                     return; // it takes a Mat
                 Mat columns, rows;
                 generator->initRectifyMap(exampleMotion(), columns, rows, CV_32FC1, noArray(), DepthMap(a.getMat()));
             }}};
}

TEST(RSAckermann_CorrectorArguments, every_array_at_every_entry)
{
    const int sizes3[] = {3, 4, 2};
    std::vector<Mat> arrays = {Mat(), Mat(3, sizes3, CV_64F, Scalar(1))};
    for (int depth = CV_8U; depth <= CV_16F; depth++)
        for (const int channels : {1, 2, 3, 4, 7})
            for (const Size& size :
                 {Size(4, 3), Size(3, 3), Size(1, 3), Size(3, 1), Size(4, 1), Size(2, 3), Size(0, 3), SIZE})
            {
                arrays.push_back(Mat(size, CV_MAKETYPE(depth, channels)));
                std::fill_n(arrays.back().data, arrays.back().total() * arrays.back().elemSize(), uchar(5));
            }
    for (const double value : {NaN, double(INFINITY), -double(INFINITY), -1., 0., 1e38, 1e-300, 1e300})
        for (const int type : {CV_32F, CV_64F, CV_32FC2, CV_64FC2, CV_32FC4})
            for (const Size& size : {Size(4, 3), Size(3, 3), Size(1, 3), SIZE})
                arrays.push_back(Mat(size, type, Scalar::all(value)));
    arrays.push_back((Mat_<double>(3, 1) << 1, 2, 3));
    const Mat large = segmentsOf(20);
    arrays.push_back(large.colRange(0, 3));
    arrays.push_back(large.rowRange(3, 9));
    for (const ArrayEntry& entry : arrayEntries())
    {
        SCOPED_TRACE(entry.name);
        int accepted = 0;
        for (const Mat& array : arrays)
        {
            SCOPED_TRACE(testing::Message() << array.size() << ", type " << array.type());
            const bool isMat = isAccepted([&]() { entry.call(array); });
            accepted += isMat;
            EXPECT_EQ(isMat, isAccepted([&]() { entry.call(array.getUMat(ACCESS_READ)); }));
        }
        EXPECT_GT(accepted, 0);
        isAccepted([&]() { entry.call(noArray()); });
        isAccepted([&]() { entry.call(std::vector<Mat>(2, large)); });
        isAccepted([&]() { entry.call(std::vector<std::vector<Point>>(2)); });
        isAccepted([&]() { entry.call(std::vector<double>(3, 1)); });
        isAccepted([&]() { entry.call(std::vector<Vec4f>(3)); });
        isAccepted([&]() { entry.call(std::vector<bool>(3)); });
        isAccepted([&]() { entry.call(Matx33d::eye()); });
        isAccepted([&]() { entry.call(large * 2); });
    }
}

//! All numbers of what an object writes, one after the other with bad values.
template <class Values>
void forEachBadField(const Values& good, const std::function<void(const Values&)>& use)
{
    FileStorage out(".yml", FileStorage::WRITE | FileStorage::MEMORY);
    good.write(out);
    const std::string text = out.releaseAndGetString();
    // The value of a key, or of an element of a list.
    const std::regex number("([:\\[,] +)(-?[0-9][-+.e0-9]*)(?=[\\s,\\]])");
    int fields = 0;
    for (std::sregex_iterator it(text.begin(), text.end(), number); it != std::sregex_iterator(); ++it, fields++)
        for (const char* bad :
             {".Nan", ".Inf", "-.Inf", "-1", "0", "7", "1e30", "1e-30", "1e300", "-1e300", "1e-300", "2147483647"})
        {
            const size_t at = size_t(it->position(2));
            const std::string changed = text.substr(0, at) + bad + text.substr(at + it->length(2));
            SCOPED_TRACE(text.substr(text.rfind('\n', at) + 1, at - text.rfind('\n', at) - 1) + bad);
            Values values = good;
            bool isRead = true;
            try
            {
                values.read(FileStorage(changed, FileStorage::READ | FileStorage::MEMORY).root());
            }
            catch (const cv::Exception&)
            {
                isRead = false; // in OpenCV's words
            }
            if (isRead)
                isAccepted([&]() { use(values); });
        }
    EXPECT_GT(fields, 3);
}

void useAll(const RollingShutterCamera& camera, const RollingShutterCorrector::Params& params, const MotionPrior& prior)
{
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera, params);
    corrector->setPrior(prior);
    Mat dst, mask;
    for (int i = 0; i < 2; i++)
    {
        const AckermannMotion motion = corrector->correctWithSegments(noise(), segmentsOf(12), dst, mask);
        EXPECT_TRUE(std::isfinite(motion.alpha) && std::isfinite(motion.wallSlope) && std::isfinite(motion.rms));
        EXPECT_TRUE(std::isfinite(motion.expectedRaw) && std::isfinite(motion.expectedResidual));
        EXPECT_TRUE(checkRange(Mat(motion.covariance)));
    }
}

void useMotion(const AckermannMotion& motion, const RollingShutterCamera& camera)
{
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    Mat map1, map2;
    isAccepted([&]() {
        generator->initRectifyMap(motion, map1, map2);
        EXPECT_TRUE(checkRange(map1) && checkRange(map2));
    });
    isAccepted([&]() { generator->initDistortMap(motion, map1, map2, CV_16SC2); });
    isAccepted([&]() { generator->correctPoints(motion, Mat(2, 1, CV_64FC2, Scalar(5, 6)), map1); });
    isAccepted([&]() { generator->validRoi(motion); });
    isAccepted([&]() { generator->optimalNewCameraMatrix(motion, 0.5, Size()); });
    double value;
    Matx33d R;
    Vec3d T;
    isAccepted([&]() { motion.yawRate(camera, value); });
    isAccepted([&]() { motion.speed(camera, value); });
    isAccepted([&]() { motion.pose(camera, 0.1, R, T); });
    isAccepted([&]() { motion.metricCovariance(camera); });
    isAccepted([&]() { motion.uprightRotation(camera); });
    isAccepted([&]() {
        Mat image(camera.imageSize, CV_8UC3, Scalar());
        drawMotion(image, segmentsOf(3), noArray(), camera, motion);
    });
}

TEST(RSAckermann_CorrectorArguments, every_value_of_every_field)
{
    RollingShutterCorrector::Params sequence;
    sequence.sequence = true;
    MotionPrior prior;
    prior.yawRate = prior.speed = prior.wallDirection = 0.1;
    prior.yawRateSigma = prior.speedSigma = prior.wallDirectionSigma = 0.2;
    forEachBadField<RollingShutterCamera>(smallCamera(), [&](const RollingShutterCamera& camera) {
        camera.check();
        if (double(camera.imageSize.width) * camera.imageSize.height > 1e6) // whose maps no memory may have place for
            return;
        useMotion(exampleMotion(), camera);
        if (camera.imageSize == SIZE)
            useAll(camera, RollingShutterCorrector::Params(), MotionPrior());
    });
    for (const RollingShutterCorrector::Params& params : {RollingShutterCorrector::Params(), sequence})
    {
        forEachBadField<RollingShutterCorrector::Params>(
            params, [&](const RollingShutterCorrector::Params& p) { useAll(smallCamera(), p, MotionPrior()); });
        forEachBadField<MotionPrior>(prior, [&](const MotionPrior& p) { useAll(smallCamera(), params, p); });
    }
    forEachBadField<MountCalibrator::Params>(MountCalibrator::Params(), [&](const MountCalibrator::Params& p) {
        const Ptr<MountCalibrator> calibrator = MountCalibrator::create(smallCamera(), p);
        for (int i = 0; i < 6; i++)
            calibrator->addFrame(noise(), 0.1 * i);
        calibrator->calibrate();
    });
    forEachBadField<AckermannMotion>(exampleMotion(),
                                     [&](const AckermannMotion& motion) { useMotion(motion, smallCamera()); });
}

struct BadMotion
{
    const char* complaint;
    int AckermannMotion::*field;
    int value;
};

// Words of a motion that are none, whatever the motion is used for.
TEST(RSAckermann_CorrectorArguments, words_of_a_motion)
{
    typedef AckermannMotion T;
    const BadMotion cases[] = {
        {"motion.status is 5; one of the MotionStatus values 0 to 4 is expected", &T::status, 5},
        {"motion.status is -1; one of", &T::status, -1},
        {"motion.model is 2; one of the MotionModel values 0, 1, 3 and 4 is expected", &T::model, 2},
        {"motion.model is -1; one of", &T::model, MODEL_AUTO},
        {"motion.direction is 0; 1 (forward) or -1 (reverse) is expected", &T::direction, 0},
        {"motion.direction is 2; 1", &T::direction, 2},
        {"motion.scale is 4; one of the MotionScale values 0 to 3 is expected", &T::scale, 4},
        {"motion.scale is -1; one of", &T::scale, -1}};
    const RollingShutterCamera camera = smallCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const Mat points(2, 1, CV_64FC2, Scalar(5, 6));
    Mat a, b, image(SIZE, CV_8UC3, Scalar());
    const std::function<void(const AckermannMotion&)> uses[] = {
        [&](const AckermannMotion& m) { corrector->correctWithMotion(noise(), m, a); },
        [&](const AckermannMotion& m) { generator->initRectifyMap(m, a, b); },
        [&](const AckermannMotion& m) { generator->initDistortMap(m, a, b); },
        [&](const AckermannMotion& m) { generator->correctPoints(m, points, a); },
        [&](const AckermannMotion& m) { generator->distortPoints(m, points, a); },
        [&](const AckermannMotion& m) { generator->validRoi(m); },
        [&](const AckermannMotion& m) { generator->optimalNewCameraMatrix(m, 0.5); },
        [&](const AckermannMotion& m) { drawMotion(image, noArray(), noArray(), camera, m); }};
    for (const auto& use : uses)
    {
        SCOPED_TRACE(&use - uses);
        EXPECT_NO_THROW(use(exampleMotion()));
        for (const BadMotion& bad : cases)
            for (const AckermannMotion& good : {exampleMotion(), AckermannMotion()})
            {
                AckermannMotion motion = good;
                motion.*bad.field = bad.value;
                try
                {
                    use(motion);
                    ADD_FAILURE() << bad.complaint;
                }
                catch (const cv::Exception& e)
                {
                    EXPECT_NE(std::string::npos, e.err.find(bad.complaint)) << e.err;
                }
            }
    }
}

//! A public function with two arguments of which it writes the second; both of them if the first one is an output.
struct TwoArrays
{
    const char* name;
    Mat first; // an input, or empty
    bool mayBeOne;
    std::function<void(InputOutputArray, OutputArray)> call;
};

std::vector<TwoArrays> entriesWithTwoArrays()
{
    const RollingShutterCamera camera = smallCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const Ptr<AckermannEstimator> estimator = AckermannEstimator::create(camera);
    const AckermannMotion motion = motionFromMetric(camera, 1, 20, 3, 3, 0);
    const Mat image = noise(), segments = segmentsOf(20), depth(SIZE, CV_32F, Scalar(9)),
              points = (Mat_<double>(2, 2) << 10, 20, 30, 40);
    std::vector<TwoArrays> list = {
        {"correct, dst and mask", Mat(), false,
         [=](InputOutputArray a, OutputArray b) { corrector->correct(image, a, b); }},
        {"correct, src and mask", image, false,
         [=](InputOutputArray a, OutputArray b) {
             Mat other;
             corrector->correct(a, other, b);
         }},
        {"correct, src and dst", image, true, [=](InputOutputArray a, OutputArray b) { corrector->correct(a, b); }},
        {"correctWithSegments, dst and mask", Mat(), false,
         [=](InputOutputArray a, OutputArray b) { corrector->correctWithSegments(image, segments, a, b); }},
        {"correctWithSegments, src and mask", image, false,
         [=](InputOutputArray a, OutputArray b) {
             Mat other;
             corrector->correctWithSegments(a, segments, other, b);
         }},
        {"correctWithSegments, segments and dst", segments, true,
         [=](InputOutputArray a, OutputArray b) { corrector->correctWithSegments(image, a, b); }},
        {"correctWithSegments, segments and mask", segments, true,
         [=](InputOutputArray a, OutputArray b) {
             Mat other;
             corrector->correctWithSegments(image, a, other, b);
         }},
        {"correctWithMotion, dst and mask", Mat(), false,
         [=](InputOutputArray a, OutputArray b) { corrector->correctWithMotion(image, motion, a, b); }},
        {"correctWithMotion, src and mask", image, false,
         [=](InputOutputArray a, OutputArray b) {
             Mat other;
             corrector->correctWithMotion(a, motion, other, b);
         }},
        {"correctWithMotion, src and dst", image, true,
         [=](InputOutputArray a, OutputArray b) { corrector->correctWithMotion(a, motion, b); }},
        {"correctWithMotion, depth and dst", depth, true,
         [=](InputOutputArray a, OutputArray b) {
             corrector->correctWithMotion(Mat(SIZE, CV_32F, Scalar(4)), motion, b, noArray(), DepthMap(a.getMat()));
         }},
        {"getSegments", Mat(), false, [=](InputOutputArray a, OutputArray b) { corrector->getSegments(a, b); }},
        {"getMaps", Mat(), false, [=](InputOutputArray a, OutputArray b) { corrector->getMaps(a, b); }},
        {"estimate, segments and labels", segments, true,
         [=](InputOutputArray a, OutputArray b) { estimator->estimate(a, b); }},
        {"estimateFromImage, image and segments", image, true,
         [=](InputOutputArray a, OutputArray b) { estimator->estimateFromImage(a, b); }},
        {"estimateFromImage, image and labels", image, true,
         [=](InputOutputArray a, OutputArray b) { estimator->estimateFromImage(a, noArray(), b); }},
        {"estimateFromImage, segments and labels", Mat(), false,
         [=](InputOutputArray a, OutputArray b) { estimator->estimateFromImage(image, a, b); }},
        {"detectSegments", image, true, [=](InputOutputArray a, OutputArray b) { detectSegments(a, b); }},
        {"correctPoints, src and dst", points, true,
         [=](InputOutputArray a, OutputArray b) { generator->correctPoints(motion, a, b); }},
        {"correctPoints, dst and mask", Mat(), false,
         [=](InputOutputArray a, OutputArray b) { generator->correctPoints(motion, points, a, noArray(), b); }},
        {"correctPoints, src and mask", points, true,
         [=](InputOutputArray a, OutputArray b) {
             Mat other;
             generator->correctPoints(motion, a, other, noArray(), b);
         }},
        {"distortPoints, src and dst", points, true,
         [=](InputOutputArray a, OutputArray b) { generator->distortPoints(motion, a, b); }},
        {"distortPoints, dst and mask", Mat(), false,
         [=](InputOutputArray a, OutputArray b) { generator->distortPoints(motion, points, a, noArray(), b); }}};
    for (const int type : {CV_32FC1, CV_32FC2, CV_16SC2})
    {
        const auto rectify = [=](OutputArray a, OutputArray b, OutputArray mask, const Mat& values) {
            generator->initRectifyMap(motion, a, b, type, mask, DepthMap(values));
        };
        const auto distort = [=](OutputArray a, OutputArray b, OutputArray mask, const Mat& values) {
            generator->initDistortMap(motion, a, b, type, mask, DepthMap(values));
        };
        const std::function<void(OutputArray, OutputArray, OutputArray, const Mat&)> functions[] = {rectify, distort};
        for (const auto& init : functions)
        {
            const auto add = [&](const char* name, const Mat& first,
                                 const std::function<void(InputOutputArray, OutputArray)>& call) {
                list.push_back({name, first, false, call});
            };
            add("maps", Mat(), [=](InputOutputArray a, OutputArray b) { init(a, b, noArray(), Mat()); });
            add("map1 and mask", Mat(), [=](InputOutputArray a, OutputArray b) {
                Mat other;
                init(a, other, b, Mat());
            });
            add("map2 and mask", Mat(), [=](InputOutputArray a, OutputArray b) {
                Mat other;
                init(other, a, b, Mat());
            });
            add("depth and map1", depth, [=](InputOutputArray a, OutputArray b) {
                Mat other;
                init(b, other, noArray(), a.getMat());
            });
            add("depth and map2", depth, [=](InputOutputArray a, OutputArray b) {
                Mat other;
                init(other, b, noArray(), a.getMat());
            });
        }
    }
    return list;
}

// One matrix for two arguments is as good as two, or refused by their names; nothing is lost.
TEST(RSAckermann_CorrectorArguments, one_matrix_for_two_arguments)
{
    for (const TwoArrays& entry : entriesWithTwoArrays())
    {
        SCOPED_TRACE(entry.name);
        Mat first = entry.first.clone(), second;
        entry.call(first, second);
        Mat one = entry.first.clone(), header = entry.first.empty() ? second.clone() : entry.first.clone(),
            other = header;
        const bool mayShareData = entry.mayBeOne || header.empty();
        EXPECT_EQ(entry.mayBeOne, isAccepted([&]() { entry.call(one, one); }));
        EXPECT_EQ(mayShareData, isAccepted([&]() { entry.call(header, other); }));
        if (entry.mayBeOne)
            for (const Mat& same : {one, other})
            {
                ASSERT_EQ(second.size(), same.size());
                EXPECT_EQ(0, second.empty() ? 0 : cvtest::norm(second, same, NORM_INF));
            }
        UMat device;
        EXPECT_TRUE(!entry.first.empty() || !isAccepted([&]() { entry.call(device, device); }));
    }
}

struct OutputEntry
{
    const char* name;
    bool isList; // whether a vector can take it
    std::function<void(OutputArray)> call;
};

std::vector<OutputEntry> outputEntries()
{
    const RollingShutterCamera camera = smallCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const Ptr<AckermannEstimator> estimator = AckermannEstimator::create(camera);
    const AckermannMotion motion = exampleMotion();
    const Mat image = noise(), segments = segmentsOf(20);
    const std::vector<Point2f> points = {Point2f(10, 20), Point2f(30, 40)};
    const Ptr<Mat> other = makePtr<Mat>(), another = makePtr<Mat>();
    corrector->correctWithSegments(image, segments, *other);
    return {
        {"correct, dst", false, [=](OutputArray a) { corrector->correct(image, a); }},
        {"correct, mask", false, [=](OutputArray a) { corrector->correct(image, *other, a); }},
        {"correctWithSegments, dst", false, [=](OutputArray a) { corrector->correctWithSegments(image, segments, a); }},
        {"correctWithMotion, dst", false, [=](OutputArray a) { corrector->correctWithMotion(image, motion, a); }},
        {"correctWithMotion, mask", false,
         [=](OutputArray a) { corrector->correctWithMotion(image, motion, *other, a); }},
        {"getSegments, segments", true, [=](OutputArray a) { corrector->getSegments(a, noArray()); }},
        {"getSegments, labels", true, [=](OutputArray a) { corrector->getSegments(noArray(), a); }},
        {"getMaps, map1", false, [=](OutputArray a) { corrector->getMaps(a, *other); }},
        {"getMaps, map2", false, [=](OutputArray a) { corrector->getMaps(*other, a); }},
        {"estimate, labels", true, [=](OutputArray a) { estimator->estimate(segments, a); }},
        {"estimateFromImage, segments", true, [=](OutputArray a) { estimator->estimateFromImage(image, a); }},
        {"detectSegments", true, [=](OutputArray a) { detectSegments(image, a); }},
        {"initRectifyMap, map1", false, [=](OutputArray a) { generator->initRectifyMap(motion, a, *other); }},
        {"initDistortMap, map2", false, [=](OutputArray a) { generator->initDistortMap(motion, *other, a, CV_16SC2); }},
        {"initRectifyMap, mask", false,
         [=](OutputArray a) { generator->initRectifyMap(motion, *other, *another, CV_32FC1, a); }},
        {"correctPoints, dst", true, [=](OutputArray a) { generator->correctPoints(motion, points, a); }},
        {"distortPoints, dst", true, [=](OutputArray a) { generator->distortPoints(motion, points, a); }},
        {"correctPoints, mask", true,
         [=](OutputArray a) { generator->correctPoints(motion, points, *other, noArray(), a); }}};
}

TEST(RSAckermann_CorrectorArguments, every_output_at_every_entry)
{
    for (const OutputEntry& entry : outputEntries())
    {
        SCOPED_TRACE(entry.name);
        const auto accepts = [&](OutputArray a) { return isAccepted([&]() { entry.call(a); }); };
        Mat plain, wrongType(SIZE, CV_16SC3);
        UMat device;
        EXPECT_TRUE(accepts(plain));
        EXPECT_TRUE(accepts(wrongType));
        EXPECT_TRUE(plain.empty() || plain.type() == wrongType.type());
        EXPECT_TRUE(accepts(device));
        Mat_<Vec3s> typed;
        Matx<short, 2, 3> fixed;
        std::vector<Mat> matrices(2);
        std::vector<std::vector<Point2f>> lists(2);
        const Mat constant(7, 5, CV_16SC3);
        EXPECT_FALSE(accepts(typed));
        EXPECT_FALSE(accepts(fixed));
        EXPECT_FALSE(accepts(matrices));
        EXPECT_FALSE(accepts(lists));
        EXPECT_FALSE(accepts(constant));
        std::vector<uchar> bytes;
        std::vector<Vec4f> segments;
        std::vector<Point2f> points;
        const bool ofBytes = accepts(bytes), ofSegments = accepts(segments), ofPoints = accepts(points);
        EXPECT_EQ(entry.isList, ofBytes || ofSegments || ofPoints);
    }
}

// Whether an image is too large doesn't depend on what is seen in it.
TEST(RSAckermann_CorrectorArguments, sides_that_remap_takes)
{
    for (const int longest : {32766, 32767})
        for (const Size& size : {Size(longest, 2), Size(2, longest)})
        {
            SCOPED_TRACE(size);
            const Ptr<RollingShutterCorrector> corrector =
                RollingShutterCorrector::create(RollingShutterCamera::fromFocal(size, 50));
            const Mat image(size, CV_8U, Scalar(7));
            Mat dst;
            EXPECT_EQ(longest == 32766, isAccepted([&]() { corrector->correct(image, dst); }));
            EXPECT_EQ(longest == 32766,
                      isAccepted([&]() { corrector->correctWithMotion(image, exampleMotion(), dst); }));
        }
    RollingShutterCorrector::Params params;
    params.warp.newSize = Size(32767, 2);
    Mat dst;
    EXPECT_FALSE(isAccepted([&]() { RollingShutterCorrector::create(smallCamera(), params)->correct(noise(), dst); }));
}

// Camera and parameters may come one after the other, in either order.
TEST(RSAckermann_CorrectorArguments, sequence_without_line_delay)
{
    RollingShutterCamera untimed = smallCamera();
    untimed.lineDelay = 0;
    RollingShutterCorrector::Params sequence;
    sequence.sequence = true;
    EXPECT_FALSE(isAccepted([&]() { RollingShutterCorrector::create(untimed, sequence); }));
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(untimed);
    corrector->setParams(sequence);
    Mat dst;
    EXPECT_FALSE(isAccepted([&]() { corrector->correct(noise(), dst); }));
    EXPECT_FALSE(isAccepted([&]() { corrector->correctWithSegments(noise(), segmentsOf(3), dst); }));
    EXPECT_TRUE(isAccepted([&]() { corrector->correctWithMotion(noise(), exampleMotion(), dst); }));
    corrector->setCamera(smallCamera());
    EXPECT_TRUE(isAccepted([&]() { corrector->correct(noise(), dst); }));
}

TEST(RSAckermann_CorrectorArguments, every_number_at_every_entry)
{
    const Mat image = noise();
    for (const double value : {NaN, double(INFINITY), -double(INFINITY), -1., 0., 1e300, -1e300, 1e-300, 1e12})
    {
        SCOPED_TRACE(value);
        RollingShutterCorrector::Params params;
        params.sequence = true;
        const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(smallCamera(), params);
        const Ptr<MountCalibrator> calibrator = MountCalibrator::create(smallCamera());
        isAccepted([&]() { corrector->setTimestamp(value); });
        isAccepted([&]() { corrector->setNextFrame(image, value); });
        isAccepted([&]() { corrector->skipFrame(); });
        isAccepted([&]() { calibrator->addFrame(image, value); });
        isAccepted([&]() { calibrator->addFrame(image, 1); });
        isAccepted([&]() { calibrator->addFrame(image, value); });
        isAccepted([&]() { calibrator->calibrate(); });
        isAccepted([&]() { RollingShutterCamera::fromFocal(SIZE, value).check(); });
        isAccepted([&]() { smallCamera().rowTime(Point2d(value, value)); });
        isAccepted([&]() {
            RollingShutterCamera camera = smallCamera();
            camera.setRollPitch(value, value);
            useMotion(exampleMotion(), camera);
        });
        isAccepted([&]() {
            RollingShutterCamera camera = smallCamera();
            camera.setGravity(Vec3d(value, value, value));
            useMotion(exampleMotion(), camera);
        });
        isAccepted([&]() { DepthMap(Mat(SIZE, CV_32F, Scalar(5)), DEPTH_RAW, value).check(); });
        isAccepted([&]() {
            Mat found;
            detectSegments(image, found, DETECTOR_VERTICALS, value);
        });
        Matx33d R;
        Vec3d T;
        isAccepted([&]() { exampleMotion().pose(smallCamera(), value, R, T); });
        isAccepted(
            [&]() { WarpMapGenerator::create(smallCamera())->optimalNewCameraMatrix(exampleMotion(), value, SIZE); });
        // Whatever it was, reset() recovers.
        corrector->reset();
        Mat dst;
        EXPECT_NO_THROW(corrector->correct(image, dst));
    }
}

}} // namespace opencv_test::
