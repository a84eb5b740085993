// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_warp_cameras.hpp"

// Maps with a given depth against the simulator, in a scene that has nothing of the motion's planes.

namespace opencv_test { namespace {

using simulation::Simulator;

//! A camera that moves as a motion says, in front of a single slanted plane, in metres.
struct Scene
{
    Scene(const RollingShutterCamera& camera_, const AckermannMotion& motion_, const Vec3d& normal)
        : camera(camera_), motion(motion_), simulator(camera_, simulation::Drive(), simulation::Street())
    {
        double speed;
        motion.speed(camera, speed);
        simulator.drive = simulation::Drive(2 * motion.alpha, speed * camera.secondsPerUnitTime(), camera.heading);
        simulator.drive.setTilt(camera, motion);
        simulator.street.normal[simulation::LEFT] = normal;
    }

    //! The point that a pixel of the raw or of the global-shutter image shows, upright at the reference row.
    Vec3d pointAt(const Point2d& pixel, bool ofRaw) const
    {
        Vec3d P;
        if (ofRaw)
        {
            simulator.locate(pixel, simulation::LEFT, P);
            return P;
        }
        const Vec3d b = camera.uprightRotation * (camera.cameraMatrix.inv() * Vec3d(pixel.x, pixel.y, 1));
        return b * simulator.street.distance(simulation::LEFT, Vec3d(), b);
    }

    DepthMap depth(int ofCamera) const
    {
        Mat1f values(camera.imageSize);
        for (int y = 0; y < values.rows; y++)
            for (int x = 0; x < values.cols; x++)
            {
                const Point2d pixel(x, y);
                const bool ofRaw = ofCamera == DEPTH_RAW;
                const Vec3d seen = pointAt(pixel, ofRaw),
                            P = ofRaw ? simulator.drive.toCamera(seen, simulator.time(pixel)) : seen;
                values(y, x) = float((camera.uprightRotation.t() * P)[2]);
            }
        return DepthMap(values, ofCamera);
    }

    RollingShutterCamera camera;
    AckermannMotion motion;
    Simulator simulator;
};

//! In front of the camera, 4 to 10 m away.
Vec3d randomNormal(RNG& rng)
{
    return Vec3d(rng.uniform(-0.05, 0.05), rng.uniform(-0.05, 0.05), rng.uniform(0.1, 0.25));
}

//! The map of either direction.
void initMap(const Ptr<WarpMapGenerator>& generator, bool distort, const AckermannMotion& motion, OutputArray map1,
             OutputArray map2, OutputArray mask, const DepthMap& depth, int m1type = CV_32FC1)
{
    if (distort)
        generator->initDistortMap(motion, map1, map2, m1type, mask, depth);
    else
        generator->initRectifyMap(motion, map1, map2, m1type, mask, depth);
}

typedef testing::TestWithParam<std::tuple<int, int, bool>> WarpDepth; // TestLens, DepthCamera, whether to distort

TEST_P(WarpDepth, equals_simulator)
{
    const bool distort = std::get<2>(GetParam());
    RNG rng(99);
    int compared = 0;
    double worst = 0;
    for (int round = 0; round < 5; round++)
    {
        RollingShutterCamera camera = lensCamera(std::get<0>(GetParam()));
        camera.height = 1.2;
        camera.imageSize = Size(340, 240); // the simulator takes its time for each pixel
        camera.cameraMatrix(0, 2) -= 150;
        camera.cameraMatrix(1, 2) -= 70;
        mountAtRandom(camera, rng);
        camera.scanDirection = round % 4;
        AckermannMotion motion = randomMotion(camera, rng);
        if (round == 4)
            addRotationCurve(motion, 17, rng); // as many vectors as with a gyro
        const Scene scene(camera, motion, randomNormal(rng));
        Mat columns, rows, mask;
        initMap(WarpMapGenerator::create(camera), distort, scene.motion, columns, rows, mask,
                scene.depth(std::get<1>(GetParam())));
        for (int y = round; y < columns.rows; y += 11)
            for (int x = round; x < columns.cols; x += 13)
            {
                const Point2d got(columns.at<float>(y, x), rows.at<float>(y, x));
                const Vec3d P = scene.pointAt(Point(x, y), distort);
                Point2d truth;
                if (!distort && !scene.simulator.project(P, truth))
                    continue;
                if (distort)
                {
                    const Vec3d p = camera.cameraMatrix * (camera.uprightRotation.t() * P);
                    truth = Point2d(p[0] / p[2], p[1] / p[2]);
                    if (!scene.simulator.inside(truth))
                        continue;
                }
                worst = std::max(worst, cv::norm(got - truth));
                EXPECT_EQ(MASK_SEEN, mask.at<uchar>(y, x)) << x << ", " << y << ", round " << round;
                compared++;
            }
    }
    EXPECT_LE(worst, 5e-4);
    EXPECT_GE(compared, 1200);
}

INSTANTIATE_TEST_CASE_P(RSAckermann, WarpDepth,
                        testing::Combine(testing::Values(ALL_LENSES), testing::Values(DEPTH_RAW, DEPTH_CORRECTED),
                                         testing::Bool()));

typedef testing::TestWithParam<std::tuple<int, bool, double>> WarpDepthMaps; // DepthCamera, whether to distort, speed

RollingShutterCamera paperCameraWithHeight()
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.height = 1.2;
    return camera;
}

//! A camera and a motion with both walls and a road, and a depth with boxes in front of a plane.
struct Boxes
{
    explicit Boxes(double speed = 16) : camera(paperCameraWithHeight())
    {
        camera.distCoeffs = {-0.2, 0.05, 1e-3, -1e-3, 0.01};
        motion = motionFromMetric(camera, 0.5, speed, 2.5, 3, 0.02);
        values.create(camera.imageSize);
        for (int y = 0; y < values.rows; y++)
            for (int x = 0; x < values.cols; x++)
                values(y, x) = 9 - 0.003f * x - 0.005f * y;
        for (int i = 0; i < 6; i++)
            values(Rect(30 + 100 * i, 60 + 30 * i, 40, 90)).setTo(3 + 0.4 * i);
    }

    RollingShutterCamera camera;
    AckermannMotion motion;
    Mat1f values;
};

struct Result
{
    Mat map1, map2, mask;

    Result(const RollingShutterCamera& camera, bool distort, const AckermannMotion& motion, const DepthMap& depth,
           const WarpMapGenerator::Params& params = WarpMapGenerator::Params())
    {
        initMap(WarpMapGenerator::create(camera, params), distort, motion, map1, map2, mask, depth);
    }

    static double difference(const Mat& a, const Mat& b, const Mat& where = Mat())
    {
        return cvtest::norm(a, b, NORM_INF, where);
    }

    double difference(const Result& other, const Mat& where = Mat()) const
    {
        return std::max(difference(map1, other.map1, where), difference(map2, other.map2, where));
    }
};

TEST(RSAckermann_DepthMap, points_fill_the_pixels_that_show_them)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    RollingShutterCamera camera(Size(40, 30), Matx33d(20, 0, 19.5, 0, 20, 14.5, 0, 0, 1));
    camera.distCoeffs = {-0.2, 0.05, 0, 0}; // not of the global-shutter camera
    std::vector<Vec3f> points = {Vec3f(0.25f, 0.25f, 10),  Vec3f(0.3f, 0.3f, 8),   Vec3f(0.25f, 0.25f, 9), // one pixel
                                 Vec3f(-1.99f, -1.49f, 2), Vec3f(2, 1.5f, 2.001f), // next to the image's corners
                                 Vec3f(-2.01f, 0, 2),      Vec3f(0, 1.51f, 2),     Vec3f(0, 0, -3),
                                 Vec3f(0, 0, 0),           Vec3f(0, 0, nan),       Vec3f(nan, 0, 5),
                                 Vec3f(0, 0, infinite),    Vec3f(infinite, 0, 5)};
    Mat1f expected(camera.imageSize, 0.f);
    expected(15, 20) = 8;
    expected(0, 0) = 2;
    expected(29, 39) = 2.001f;
    const DepthMap depth = DepthMap::fromPoints(points, camera);
    EXPECT_EQ(DEPTH_CORRECTED, depth.camera);
    EXPECT_EQ(DEPTH_METRIC, depth.kind);
    EXPECT_EQ(0, cvtest::norm(expected, depth.values, NORM_INF));

    const Mat rows = Mat(points).reshape(1);
    Mat doubles;
    rows.convertTo(doubles, CV_64F);
    for (const Mat& same : {rows, doubles, Mat(Mat(points).t())})
        EXPECT_EQ(0, cvtest::norm(expected, DepthMap::fromPoints(same, camera).values, NORM_INF));
    EXPECT_EQ(0, countNonZero(DepthMap::fromPoints(std::vector<Vec3f>(), camera).values));
    for (const Mat& wrong : {Mat(4, 2, CV_32F), Mat(4, 3, CV_32S), Mat(4, 3, CV_32FC2)})
    {
        try
        {
            DepthMap::fromPoints(wrong, camera);
            ADD_FAILURE();
        }
        catch (const cv::Exception& e)
        {
            EXPECT_NE(String::npos, e.err.find("points is a 4 x")) << e.err;
        }
    }
}

// One pixel in a hundred is known: between them it is as if all were, where the scene is smooth.
TEST_P(WarpDepthMaps, few_points)
{
    const int ofCamera = std::get<0>(GetParam());
    const bool distort = std::get<1>(GetParam());
    RNG rng(5);
    const double speed = std::get<2>(GetParam());
    const Scene scene(paperCameraWithHeight(), motionFromMetric(paperCameraWithHeight(), 0.5, speed, 2.5, 3, 0.02),
                      Vec3d(0.03, 0.02, 0.15));
    const DepthMap all = scene.depth(ofCamera);
    DepthMap few(Mat(Mat1f(all.values.size(), 0.f)), ofCamera);
    for (int i = 0; i < int(all.values.total()) / 100; i++)
    {
        const Point pixel(rng.uniform(0, all.values.cols), rng.uniform(0, all.values.rows));
        few.values.at<float>(pixel) = all.values.at<float>(pixel);
    }
    const Result planes(scene.camera, distort, scene.motion, DepthMap()),
        truth(scene.camera, distort, scene.motion, all), got(scene.camera, distort, scene.motion, few);
    const Mat seen = truth.mask == MASK_SEEN;
    const auto mean = [&](const Result& result) {
        Mat distance;
        magnitude(result.map1 - truth.map1, result.map2 - truth.map2, distance);
        return cv::mean(distance, seen)[0];
    };
    EXPECT_LT(mean(got), 0.05 * mean(planes));
}

TEST_P(WarpDepthMaps, sixteen_bits_with_a_scale)
{
    const int ofCamera = std::get<0>(GetParam());
    const bool distort = std::get<1>(GetParam());
    const Boxes boxes(std::get<2>(GetParam()));
    Mat units, metres;
    boxes.values.convertTo(units, CV_16U, 256);
    units.convertTo(metres, CV_32F, 1. / 256);
    const Result expected(boxes.camera, distort, boxes.motion, DepthMap(metres, ofCamera)),
        got(boxes.camera, distort, boxes.motion, DepthMap(units, ofCamera, 1. / 256));
    EXPECT_EQ(0, got.difference(expected));
    EXPECT_EQ(0, Result::difference(got.mask, expected.mask));
}

// A relative depth with the scale and shift of a metric one: what is unknown or negative is so in both.
TEST_P(WarpDepthMaps, relative_equals_metric)
{
    const int ofCamera = std::get<0>(GetParam());
    const bool distort = std::get<1>(GetParam());
    Boxes boxes(std::get<2>(GetParam()));
    const double way = std::abs(std::get<2>(GetParam())) * boxes.camera.secondsPerUnitTime();
    boxes.values(Rect(300, 200, 20, 20)).setTo(0.1); // nearer than possible
    boxes.values(Rect(400, 100, 30, 30)).setTo(1e9);
    DepthMap relative(Mat(boxes.values.size(), CV_32F), ofCamera, 0.5 * way, DEPTH_RELATIVE);
    relative.shift = -3 * way;
    for (int y = 0; y < boxes.values.rows; y++)
        for (int x = 0; x < boxes.values.cols; x++)
            relative.values.at<float>(y, x) = boxes.values(y, x) > 1e8 ? -7 : 2 * (1 / boxes.values(y, x) + 3);
    boxes.values(Rect(0, 0, 50, 50)).setTo(0);
    relative.values(Rect(0, 0, 50, 50)).setTo(std::numeric_limits<float>::quiet_NaN());
    const Result expected(boxes.camera, distort, boxes.motion, DepthMap(boxes.values, ofCamera));
    AckermannMotion withoutMetres = boxes.motion;
    withoutMetres.wallDistance = 0;
    withoutMetres.scale = SCALE_UNKNOWN;
    const Result got(boxes.camera, distort, withoutMetres, relative);
    // Beside the boxes rounding decides which surface is seen.
    Mat distance;
    cv::absdiff(got.map1, expected.map1, distance);
    EXPECT_LE(countNonZero(distance > 1e-3), 20);
    EXPECT_LE(countNonZero(got.mask != expected.mask), 20);
}

// A box hides a stripe on one side, which is as wide as it moves against what is behind.
TEST_P(WarpDepthMaps, boxes_hide)
{
    const Boxes boxes(std::get<2>(GetParam()));
    const Result result(boxes.camera, std::get<1>(GetParam()), boxes.motion,
                        DepthMap(boxes.values, std::get<0>(GetParam())));
    const int hidden = countNonZero(result.mask == MASK_HIDDEN);
    EXPECT_GT(hidden, 100);
    EXPECT_LT(hidden, 6000);
    const Result even(boxes.camera, std::get<1>(GetParam()), boxes.motion,
                      DepthMap(Mat(boxes.values.size(), CV_32F, Scalar(8)), std::get<0>(GetParam())));
    EXPECT_EQ(0, countNonZero(even.mask == MASK_HIDDEN));
}

TEST_P(WarpDepthMaps, nothing_known)
{
    const int ofCamera = std::get<0>(GetParam());
    const bool distort = std::get<1>(GetParam());
    Boxes boxes(std::get<2>(GetParam()));
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (const bool hasOffset : {false, true})
    {
        SCOPED_TRACE(hasOffset);
        if (hasOffset)
        {
            boxes.motion.inverseDepthOffset =
                0.02 * (Mat_<double>(4, 4) << 1, 2, 0, -1, 2, 3, 1, 0, 0, 2, -1, 1, 1, 0, 1, 2);
            boxes.motion.offsetArea = Rect2d(-0.6, -0.4, 1.2, 0.8);
        }
        const Result without(boxes.camera, distort, boxes.motion, DepthMap());
        const Mat seen = without.mask == MASK_SEEN;
        for (const float unknown : {0.f, -5.f, nan, inf, 1e-3f})
        {
            const Result result(boxes.camera, distort, boxes.motion,
                                DepthMap(Mat(boxes.camera.imageSize, CV_32F, Scalar(unknown)), ofCamera));
            // Where two planes meet the depth between pixels is a straight line; elsewhere the places are those of
            // planes, and nearly so of the offset.
            EXPECT_LE(result.difference(without, seen), hasOffset ? 0.01 : 5e-3) << unknown;
            EXPECT_LE(cvtest::norm(result.map1, without.map1, NORM_L1, seen) / countNonZero(seen),
                      hasOffset ? 1e-3 : 1e-4)
                << unknown;
            EXPECT_LE(countNonZero((result.mask != without.mask) & seen), 2) << unknown; // at the border
        }
    }
}

// Nearer than twice the way to the farther end of the image, wherever the reference row is and whatever way it goes.
TEST_P(WarpDepthMaps, what_is_too_near_is_unknown)
{
    const int ofCamera = std::get<0>(GetParam());
    const bool distort = std::get<1>(GetParam());
    Boxes boxes;
    boxes.camera.imageSize = Size(160, 96);
    boxes.camera.cameraMatrix = Matx33d(204, 0, 79, 0, 204, 47, 0, 0, 1);
    boxes.camera.lineDelay *= 4;
    const double speed = std::get<2>(GetParam());
    for (int scan = SCAN_TOP_TO_BOTTOM; scan <= SCAN_RIGHT_TO_LEFT; scan++)
        for (const double share : {0., 0.3, 1.})
        {
            RollingShutterCamera camera = boxes.camera;
            camera.scanDirection = scan;
            const double last = (camera.isRowShutter() ? camera.imageSize.height : camera.imageSize.width) - 1;
            camera.referenceRow = share * last;
            const AckermannMotion motion = motionFromMetric(camera, 0.5, speed, 2.5, 3, 0.02);
            const double nearest = 2 * std::abs(speed) * std::max(share, 1 - share) * last * camera.lineDelay;
            Mat1f values(camera.imageSize, 0.f);
            const Result unknown(camera, distort, motion, DepthMap(values.clone(), ofCamera));
            for (const double factor : {0.98, 1.02})
            {
                values = float(factor * nearest);
                const double unit = 1e-4;
                const Mat units(values.size(), CV_16U, Scalar(factor * nearest / unit));
                for (const DepthMap& depth : {DepthMap(values, ofCamera), DepthMap(units, ofCamera, unit)})
                {
                    const Result result(camera, distort, motion, depth);
                    EXPECT_EQ(factor < 1, result.difference(unknown) < 0.01)
                        << speed << ", " << scan << ", " << share << ", " << factor << ", " << depth.scale;
                }
            }
        }
}

// Of many boxes in front of one another the nearest one is seen: each pixel of the depth is moved to where the other
// camera sees it, and there the map leads back to the nearest of those that meet.
TEST_P(WarpDepthMaps, nearest_of_many_boxes)
{
    const bool ofRaw = std::get<0>(GetParam()) == DEPTH_RAW, distort = std::get<1>(GetParam());
    if (ofRaw == distort)
        return; // the depth is that of the map's own pixels: there is nothing to search for
    RNG rng(8);
    const double speed = std::get<2>(GetParam());
    for (const int scan : {SCAN_TOP_TO_BOTTOM, SCAN_BOTTOM_TO_TOP, SCAN_LEFT_TO_RIGHT})
    {
        SCOPED_TRACE(testing::Message() << speed << ", " << scan);
        RollingShutterCamera camera(Size(160, 96), Matx33d(150, 0, 70, 0, 155, 50, 0, 0, 1));
        camera.lineDelay = 3e-4;
        camera.height = 1.2;
        camera.referenceRow = 30;
        camera.scanDirection = scan;
        camera.setRollPitch(0.03, -0.05);
        const AckermannMotion motion = motionFromMetric(camera, 0.8, speed, 2.5, 3, 0.02);
        const Simulator simulator = Simulator::fromMetric(camera, 0.8, speed, 0, 0, 0);
        Mat1f values(camera.imageSize, 9.f);
        for (int i = 0; i < 40; i++)
        {
            const Rect box(rng.uniform(0, 150), rng.uniform(0, 90), rng.uniform(6, 40), rng.uniform(6, 40));
            values(box & Rect(Point(), values.size())) = rng.uniform(2.5f, 8.f);
        }
        Mat1f nearest(values.size(), 0.f); // inverse depths
        Mat_<Point> from(values.size(), Point());
        for (int y = 0; y < values.rows; y++)
            for (int x = 0; x < values.cols; x++)
            {
                const Point2d pixel(x, y);
                const double t = ofRaw ? simulator.time(pixel) : 0;
                const Vec3d P = simulator.drive.position(t) +
                                simulator.drive.turn(simulator.bearing(pixel) * double(values(y, x)), t);
                Point2d place;
                if (!(ofRaw ? simulator.pixelOf(P, place) && simulator.inside(place) : simulator.project(P, place)))
                    continue;
                const Point at(cvRound(place.x), cvRound(place.y));
                if (1 / values(y, x) <= nearest(at))
                    continue;
                nearest(at) = 1 / values(y, x);
                from(at) = Point(x, y);
            }
        const Result result(camera, distort, motion, DepthMap(values, std::get<0>(GetParam())));
        int compared = 0, wrong = 0;
        for (int y = 1; y + 1 < values.rows; y++)
            for (int x = 1; x + 1 < values.cols; x++)
            {
                // Inside of a surface
                const Mat around = nearest(Rect(x - 1, y - 1, 3, 3));
                if (nearest(y, x) == 0 || countNonZero(around == nearest(y, x)) < 9)
                    continue;
                compared++;
                const Point2d found(result.map1.at<float>(y, x), result.map2.at<float>(y, x));
                wrong += cv::norm(found - Point2d(from(y, x))) > 1.5 || result.mask.at<uchar>(y, x) != MASK_SEEN;
            }
        EXPECT_GT(compared, 3000);
        EXPECT_LE(wrong, 0.01 * compared); // where many pixels of the depth share one
    }
}

// The step between known and unknown depths is spread over the hole.
TEST_P(WarpDepthMaps, holes_have_no_seams)
{
    const int ofCamera = std::get<0>(GetParam());
    const bool distort = std::get<1>(GetParam());
    const Boxes boxes(std::get<2>(GetParam()));
    Mat1f values(boxes.camera.imageSize, 5.f);
    const Result whole(boxes.camera, distort, boxes.motion, DepthMap(values.clone(), ofCamera));
    for (int x = 20; x < values.cols; x += 120)
        for (int y = 20; y < values.rows; y += 90)
            circle(values, Point(x, y), 10 + x / 20, Scalar(0), FILLED);
    const Result holes(boxes.camera, distort, boxes.motion, DepthMap(values, ofCamera)),
        without(boxes.camera, distort, boxes.motion, DepthMap());
    EXPECT_GT(without.difference(whole, whole.mask), 2.);
    EXPECT_GT(holes.difference(whole, whole.mask), 0.2);
    for (const Mat& shift : {Mat(holes.map1 - whole.map1), Mat(holes.map2 - whole.map2)})
    {
        const Mat inside = whole.mask(Rect(1, 1, shift.cols - 1, shift.rows - 1));
        const Mat here = shift(Rect(1, 1, shift.cols - 1, shift.rows - 1)),
                  left = shift(Rect(0, 1, shift.cols - 1, shift.rows - 1)),
                  above = shift(Rect(1, 0, shift.cols - 1, shift.rows - 1));
        Mat seen;
        erode(inside, seen, Mat());
        EXPECT_LE(cvtest::norm(here, left, NORM_INF, seen), 0.25);
        EXPECT_LE(cvtest::norm(here, above, NORM_INF, seen), 0.25);
    }
    EXPECT_EQ(0, countNonZero(holes.mask == MASK_HIDDEN));
}

TEST_P(WarpDepthMaps, types_and_threads)
{
    const int ofCamera = std::get<0>(GetParam());
    const bool distort = std::get<1>(GetParam());
    const Boxes boxes(std::get<2>(GetParam()));
    const DepthMap depth(boxes.values, ofCamera);
    const Result expected(boxes.camera, distort, boxes.motion, depth);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(boxes.camera);
    Mat map1, map2, mask;
    initMap(generator, distort, boxes.motion, map1, map2, mask, depth, CV_32FC2);
    std::vector<Mat> planes;
    split(map1, planes);
    EXPECT_EQ(0, cvtest::norm(planes[0], expected.map1, NORM_INF));
    EXPECT_EQ(0, cvtest::norm(planes[1], expected.map2, NORM_INF));
    EXPECT_EQ(0, cvtest::norm(mask, expected.mask, NORM_INF));

    initMap(generator, distort, boxes.motion, map1, map2, noArray(), depth, CV_16SC2);
    Mat columns, rows;
    convertMaps(map1, map2, columns, rows, CV_32FC1);
    EXPECT_LE(cvtest::norm(columns, expected.map1, NORM_INF), 1. / 64 + 1e-4);

    UMat device1, device2, deviceMask;
    initMap(generator, distort, boxes.motion, device1, device2, deviceMask, depth);
    EXPECT_EQ(0, cvtest::norm(device1.getMat(ACCESS_READ), expected.map1, NORM_INF));
    EXPECT_EQ(0, cvtest::norm(deviceMask.getMat(ACCESS_READ), expected.mask, NORM_INF));

    const int threads = getNumThreads();
    setNumThreads(1);
    const Result alone(boxes.camera, distort, boxes.motion, depth);
    setNumThreads(threads);
    EXPECT_EQ(0, alone.difference(expected));
    EXPECT_EQ(0, cvtest::norm(alone.mask, expected.mask, NORM_INF));
}

// Without one depths of the map's own camera are read tile by tile, unless some aren't known.
TEST_P(WarpDepthMaps, a_mask_changes_nothing)
{
    const int ofCamera = std::get<0>(GetParam());
    const bool distort = std::get<1>(GetParam());
    Boxes boxes(std::get<2>(GetParam()));
    for (int holes = 0; holes < 2; holes++)
    {
        if (holes > 0)
            boxes.values(Rect(300, 200, 20, 20)).setTo(0);
        const DepthMap depth(boxes.values, ofCamera);
        const Result expected(boxes.camera, distort, boxes.motion, depth);
        Mat map1, map2;
        initMap(WarpMapGenerator::create(boxes.camera), distort, boxes.motion, map1, map2, noArray(), depth);
        EXPECT_LE(cvtest::norm(map1, expected.map1, NORM_INF), 5e-4) << holes;
        EXPECT_LE(cvtest::norm(map2, expected.map2, NORM_INF), 5e-4) << holes;
    }
}

TEST_P(WarpDepthMaps, edges_of_the_values)
{
    applyTestTag(CV_TEST_TAG_LONG);
    const int ofCamera = std::get<0>(GetParam());
    const bool distort = std::get<1>(GetParam());
    const Boxes boxes(std::get<2>(GetParam()));
    RNG rng(5);
    const float odd[] = {0.f,
                         1e-30f,
                         1e30f,
                         -1e30f,
                         std::numeric_limits<float>::quiet_NaN(),
                         std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity(),
                         std::numeric_limits<float>::denorm_min(),
                         0.3f,
                         1e5f};
    Mat1f values(boxes.camera.imageSize);
    for (int y = 0; y < values.rows; y++)
        for (int x = 0; x < values.cols; x++)
            values(y, x) = rng.uniform(0, 8) == 0 ? odd[rng.uniform(0, 10)] : rng.uniform(0.5f, 30.f);
    const Result result(boxes.camera, distort, boxes.motion, DepthMap(values, ofCamera));
    EXPECT_TRUE(checkRange(result.map1) && checkRange(result.map2));
}

INSTANTIATE_TEST_CASE_P(RSAckermann, WarpDepthMaps,
                        testing::Combine(testing::Values(DEPTH_RAW, DEPTH_CORRECTED), testing::Bool(),
                                         testing::Values(16., -12.)));

// Without a way in metres depths change nothing, or mean nothing.
TEST(RSAckermann_WarpDepth, other_motions)
{
    const Boxes boxes;
    const DepthMap depth(boxes.values);
    AckermannMotion motion = boxes.motion;
    motion.status = MOTION_NOT_SIGNIFICANT;
    EXPECT_EQ(0,
              Result(boxes.camera, false, motion, depth).difference(Result(boxes.camera, false, motion, DepthMap())));

    motion = AckermannMotion();
    motion.status = MOTION_OK;
    motion.alpha = 0.01;
    EXPECT_EQ(0,
              Result(boxes.camera, false, motion, depth).difference(Result(boxes.camera, false, motion, DepthMap())));

    motion = boxes.motion;
    motion.wallDistance = 0;
    motion.scale = SCALE_UNKNOWN;
    EXPECT_THROW(Result(boxes.camera, false, motion, depth), cv::Exception);
    motion.scale = SCALE_ROAD;
    EXPECT_LE(Result(boxes.camera, false, motion, depth).difference(Result(boxes.camera, false, boxes.motion, depth)),
              1e-3);
}

TEST(RSAckermann_WarpDepth, parts_of_the_image)
{
    const Boxes boxes;
    const Result whole(boxes.camera, false, boxes.motion, DepthMap(boxes.values)),
        own(boxes.camera, false, boxes.motion, DepthMap(boxes.values, DEPTH_CORRECTED));
    const Rect part(170, 90, 211, 133);
    WarpMapGenerator::Params params;
    params.newSize = part.size();
    params.newCameraMatrix = boxes.camera.cameraMatrix;
    params.newCameraMatrix(0, 2) -= part.x;
    params.newCameraMatrix(1, 2) -= part.y;
    const Result got(boxes.camera, false, boxes.motion, DepthMap(boxes.values), params),
        gotOwn(boxes.camera, false, boxes.motion, DepthMap(boxes.values(part), DEPTH_CORRECTED), params);
    Mat differs = got.map1 - whole.map1(part);
    EXPECT_LE(countNonZero((differs > 1e-3) | (differs < -1e-3)),
              20); // at edges, where a surface is met or just missed
    EXPECT_LE(Result::difference(gotOwn.map1, own.map1(part)), 5e-4);
}

// What hides is near what it hides: in a part of an image the same is hidden.
TEST(RSAckermann_WarpDepth, hidden_in_parts_of_the_image)
{
    const Boxes boxes;
    const Result whole(boxes.camera, false, boxes.motion, DepthMap(boxes.values, DEPTH_CORRECTED));
    const Rect hidden = boundingRect(whole.mask == MASK_HIDDEN), all(Point(), boxes.values.size()),
               part = Rect(hidden.x - 30, hidden.y - 30, hidden.width + 60, hidden.height + 60) & all;
    ASSERT_LT(part.area(), all.area());
    WarpMapGenerator::Params params;
    params.newSize = part.size();
    params.newCameraMatrix = boxes.camera.cameraMatrix;
    params.newCameraMatrix(0, 2) -= part.x;
    params.newCameraMatrix(1, 2) -= part.y;
    const Result got(boxes.camera, false, boxes.motion, DepthMap(boxes.values(part), DEPTH_CORRECTED), params);
    EXPECT_GT(countNonZero(got.mask == MASK_HIDDEN), 100);
    EXPECT_LE(countNonZero(got.mask != whole.mask(part)), 20);
}

// What hides what doesn't depend on where a larger global-shutter image has it.
TEST(RSAckermann_WarpDepth, hidden_in_a_larger_image)
{
    const Boxes boxes;
    for (const DepthCamera camera : {DEPTH_RAW, DEPTH_CORRECTED})
    {
        const Point shift(boxes.values.size());
        Mat1f values = boxes.values;
        WarpMapGenerator::Params params;
        params.newSize = values.size() + Size(2 * shift);
        params.newCameraMatrix = boxes.camera.cameraMatrix;
        params.newCameraMatrix(0, 2) += shift.x;
        params.newCameraMatrix(1, 2) += shift.y;
        const Result same(boxes.camera, true, boxes.motion, DepthMap(values, camera));
        if (camera == DEPTH_CORRECTED)
            cv::copyMakeBorder(boxes.values, values, shift.y, shift.y, shift.x, shift.x, BORDER_CONSTANT, Scalar(0));
        const Result larger(boxes.camera, true, boxes.motion, DepthMap(values, camera), params);
        const Mat hidden = same.mask == MASK_HIDDEN;
        EXPECT_GT(countNonZero(hidden), 100) << camera;
        EXPECT_LE(countNonZero((larger.mask != same.mask) & (same.mask != 0)), 20) << camera;
    }
}

// No place in an image of one column has four pixels around it.
TEST(RSAckermann_WarpDepth, one_column)
{
    const Boxes boxes;
    const Rect part(230, 0, 1, boxes.values.rows);
    WarpMapGenerator::Params params;
    params.newSize = part.size();
    params.newCameraMatrix = boxes.camera.cameraMatrix;
    params.newCameraMatrix(0, 2) -= part.x;
    const DepthMap depth(boxes.values(part).clone(), DEPTH_CORRECTED);
    const Result whole(boxes.camera, false, boxes.motion, DepthMap(boxes.values, DEPTH_CORRECTED)),
        got(boxes.camera, false, boxes.motion, depth, params), back(boxes.camera, true, boxes.motion, depth, params);
    EXPECT_LE(Result::difference(got.map1, whole.map1(part)), 5e-4);
    EXPECT_LE(Result::difference(got.map2, whole.map2(part)), 5e-4);
    EXPECT_TRUE(checkRange(back.map1) && checkRange(back.map2));
}

TEST(RSAckermann_WarpDepth, bad_arguments)
{
    const Boxes boxes;
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(boxes.camera);
    Mat map1, map2;
    const auto refuses = [&](const DepthMap& depth, const String& words) {
        try
        {
            generator->initRectifyMap(boxes.motion, map1, map2, CV_32FC1, noArray(), depth);
        }
        catch (const cv::Exception& e)
        {
            return e.err.find(words) != String::npos;
        }
        return false;
    };
    const Size size = boxes.camera.imageSize;
    EXPECT_TRUE(refuses(DepthMap(Mat(size, CV_64F, Scalar(5))), "depth.values"));
    EXPECT_TRUE(refuses(DepthMap(Mat(size, CV_32FC2, Scalar(5))), "CV_32FC2"));
    EXPECT_TRUE(refuses(DepthMap(boxes.values.rowRange(1, 100)), "640 x 99"));
    EXPECT_TRUE(refuses(DepthMap(boxes.values, 2), "depth.camera is 2"));
    EXPECT_TRUE(refuses(DepthMap(boxes.values, DEPTH_RAW, 0), "depth.scale is 0"));
    EXPECT_TRUE(refuses(DepthMap(boxes.values, DEPTH_RAW, -1), "depth.scale is -1"));
    EXPECT_TRUE(refuses(DepthMap(boxes.values, DEPTH_RAW, std::numeric_limits<double>::infinity()), "depth.scale"));
    AckermannMotion unknown = boxes.motion;
    unknown.wallDistance = 0;
    unknown.scale = SCALE_UNKNOWN;
    EXPECT_THROW(generator->initDistortMap(unknown, map1, map2, CV_32FC1, noArray(), DepthMap(boxes.values)),
                 cv::Exception);
}

}} // namespace opencv_test::
