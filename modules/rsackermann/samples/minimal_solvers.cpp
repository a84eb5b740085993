// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// The method of P. Purkait and C. Zach, "Minimal Solvers for Monocular Rolling Shutter Compensation under Ackermann
// Motion" (WACV 2018), by the minimal solvers alone: four vertical segments tell a motion, and the motion with which
// most segments agree is taken. The camera is upright.

#include "opencv2/rsackermann.hpp"
#include "opencv2/core/utility.hpp"
#include "opencv2/imgcodecs.hpp"
#include "opencv2/imgproc.hpp"
#include <algorithm>
#include <iostream>

using namespace cv;
using namespace cv::rsackermann;

static const char* const KEYS = "{help h     |           | print this message}"
                                "{@image     |           | raw image of an upright camera}"
                                "{@corrected | corrected.png | corrected image}"
                                "{focal      | 0         | focal length in pixels; 0: 0.9 times the longer side}"
                                "{line_delay | 3.5e-5    | seconds between two rows}"
                                "{samples    | 500       | number of samples}";

//! [bearing]
// Where the ends of a segment are seen in the horizontal plane, and when.
static VerticalSegment verticalSegment(const RollingShutterCamera& camera, const Vec4f& ends)
{
    const Matx33d& K = camera.cameraMatrix;
    const Point2d u(ends[0], ends[1]), v(ends[2], ends[3]);
    VerticalSegment segment;
    segment.u = HorizontalBearing((u.x - K(0, 2)) / K(0, 0), 1);
    segment.v = HorizontalBearing((v.x - K(0, 2)) / K(0, 0), 1);
    segment.timeU = camera.rowTime(u);
    segment.timeV = camera.rowTime(v);
    return segment;
}
//! [bearing]

//! [motion]
static AckermannMotion motionOf(const MinimalSolution& solution)
{
    AckermannMotion motion;
    motion.status = MOTION_OK;
    motion.model = MODEL_4LA;
    motion.alpha = solution.alpha;
    motion.wallSlope = solution.wallSlope;
    motion.wallOffset = solution.wallOffset;
    motion.wallRatio = solution.wallRatio;
    return motion;
}
//! [motion]

//! [score]
// How many segments a motion makes upright: both of their ends have the same column then.
static int countUpright(const Ptr<WarpMapGenerator>& generator, const AckermannMotion& motion,
                        const std::vector<Point2d>& ends)
{
    const double threshold = 0.5; // pixels
    std::vector<Point2d> corrected;
    generator->correctPoints(motion, ends, corrected);
    int count = 0;
    for (size_t i = 0; i < corrected.size(); i += 2)
        count += std::abs(corrected[i].x - corrected[i + 1].x) < threshold;
    return count;
}
//! [score]

int main(int argc, char** argv)
{
    const CommandLineParser parser(argc, argv, KEYS);
    if (parser.has("help") || !parser.has("@image"))
    {
        parser.printMessage();
        return parser.has("help") ? 0 : 2;
    }
    const Mat image = imread(parser.get<String>("@image"));
    if (image.empty())
    {
        std::cerr << parser.get<String>("@image") << " can't be read" << std::endl;
        return 1;
    }
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(image.size(), parser.get<double>("focal"));
    camera.lineDelay = parser.get<double>("line_delay");

    // Segments that may be images of vertical lines, from left to right.
    const float steepest = 0.35f;
    std::vector<Vec4f> found, segments;
    detectSegments(image, found);
    for (size_t i = 0; i < found.size(); i++)
        if (std::abs(found[i][0] - found[i][2]) < steepest * std::abs(found[i][1] - found[i][3]))
            segments.push_back(found[i]);
    if (segments.size() < 5)
    {
        std::cerr << "there are " << segments.size() << " vertical segments; 5 are needed" << std::endl;
        return 1;
    }
    std::sort(segments.begin(), segments.end(),
              [](const Vec4f& a, const Vec4f& b) { return a[0] + a[2] < b[0] + b[2]; });
    std::vector<Point2d> ends;
    for (size_t i = 0; i < segments.size(); i++)
    {
        ends.push_back(Point2d(segments[i][0], segments[i][1]));
        ends.push_back(Point2d(segments[i][2], segments[i][3]));
    }

    //! [sample]
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    RNG rng(1);
    AckermannMotion best;
    for (int k = 0; k < parser.get<int>("samples"); k++)
    {
        // Three segments of the left wall and one of the right one.
        int chosen[4];
        for (int i = 0; i < 4; i++)
            chosen[i] = rng.uniform(0, int(segments.size()));
        std::sort(chosen, chosen + 4);
        VerticalSegment sample[4];
        for (int i = 0; i < 4; i++)
            sample[i] = verticalSegment(camera, segments[chosen[i]]);
        MinimalSolution solutions[3];
        const int count = solve4LA(sample, true, SolverOptions(), solutions);
        for (int i = 0; i < count; i++)
        {
            AckermannMotion motion = motionOf(solutions[i]);
            motion.inliers = motion.wallSlope > 0 ? countUpright(generator, motion, ends) : 0; // a car drives forward
            if (motion.inliers > best.inliers)
                best = motion;
        }
    }
    //! [sample]

    double yawRate = 0;
    best.yawRate(camera, yawRate);
    std::cout << best.inliers << " of " << segments.size() << " segments agree, yaw rate " << yawRate * 180 / CV_PI
              << " deg/s" << std::endl;
    Mat map1, map2, corrected;
    generator->initRectifyMap(best, map1, map2);
    remap(image, corrected, map1, map2, INTER_LINEAR);
    if (!imwrite(parser.get<String>("@corrected"), corrected))
    {
        std::cerr << parser.get<String>("@corrected") << " can't be written" << std::endl;
        return 1;
    }
    return 0;
}
