// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_image_arguments.hpp"
#include "opencv2/rsackermann/calibration.hpp"
#include "opencv2/rsackermann/corrector.hpp"

namespace opencv_test { namespace {

std::vector<Entry> entries(const RollingShutterCamera& camera)
{
    const Mat segments = (Mat_<float>(1, 4) << 20, 5, 21, 40);
    std::vector<Entry> list;
    list.push_back({"addFrame", true, [camera](InputArray image) {
                        const Ptr<MountCalibrator> calibrator = MountCalibrator::create(camera);
                        for (int i = 0; i < 3; i++)
                            calibrator->addFrame(image, 0.1 * i);
                    }});
    for (int mode = 0; mode < 3; mode++) // each image alone, a sequence, a sequence whose points aren't tracked
    {
        RollingShutterCorrector::Params params;
        params.sequence = mode > 0;
        params.trackPoints = mode < 2;
        const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera, params);
        list.push_back({"correct", true, [corrector](InputArray image) {
                            Mat dst;
                            corrector->correct(image, dst);
                        }});
        list.push_back({"setNextFrame", true, [corrector](InputArray image) { corrector->setNextFrame(image, NaN); }});
        list.push_back({"correctWithSegments", mode == 1, [corrector, segments](InputArray image) {
                            Mat dst;
                            for (int i = 0; i < 3; i++)
                                corrector->correctWithSegments(image, segments, dst);
                        }});
        list.push_back({"correctWithMotion", false, [corrector](InputArray image) {
                            Mat dst;
                            corrector->correctWithMotion(image, exampleMotion(), dst);
                        }});
    }
    return list;
}

TEST(RSAckermann_CorrectorImageArguments, every_type_at_every_entry)
{
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(61, 47));
    camera.lineDelay = 1e-4;
    checkEveryType(camera, entries(camera));
}

// Of cv::remap, whether or not the image is copied since there is nothing to correct.
TEST(RSAckermann_CorrectorImageArguments, channels_of_each_interpolation)
{
    const Size size(61, 47);
    for (const int interpolation : {INTER_NEAREST, INTER_LINEAR, INTER_CUBIC, INTER_LANCZOS4})
        for (const int channels : {4, 5})
        {
            SCOPED_TRACE(testing::Message() << interpolation << ", " << channels << " channels");
            if (channels == 5 && interpolation != INTER_CUBIC && interpolation != INTER_LANCZOS4)
                continue; // depends on the version of OpenCV
            RollingShutterCorrector::Params params;
            params.interpolation = interpolation;
            const Ptr<RollingShutterCorrector> corrector =
                RollingShutterCorrector::create(RollingShutterCamera::fromFocal(size), params);
            const GuardedImage guarded(size, CV_8UC(channels));
            const Entry entries[] = {{"correctWithSegments", false,
                                      [&](InputArray src) {
                                          Mat dst;
                                          corrector->correctWithSegments(src, Mat(0, 4, CV_32F), dst);
                                      }},
                                     {"correctWithMotion, a copy", false,
                                      [&](InputArray src) {
                                          Mat dst;
                                          corrector->correctWithMotion(src, AckermannMotion(), dst);
                                      }},
                                     {"correctWithMotion", false, [&](InputArray src) {
                                          Mat dst;
                                          corrector->correctWithMotion(src, exampleMotion(), dst);
                                      }}};
            for (const Entry& entry : entries)
                EXPECT_EQ(channels == 4, isAccepted(entry, guarded.image)) << entry.name;
        }
}

// The labels of a segmentation.
TEST(RSAckermann_CorrectorImageArguments, labels_are_moved_to_the_nearest_pixel)
{
    const Size size(61, 47);
    Mat labels(size, CV_16U), expected, found;
    theRNG().fill(labels, RNG::UNIFORM, 0, 100);
    for (const int interpolation : {INTER_NEAREST, INTER_LINEAR})
        for (const int type : {CV_8SC1, CV_32SC1})
        {
            SCOPED_TRACE(testing::Message() << interpolation << ", " << typeToString(type));
            RollingShutterCorrector::Params params;
            params.interpolation = interpolation;
            const Ptr<RollingShutterCorrector> corrector =
                RollingShutterCorrector::create(RollingShutterCamera::fromFocal(size), params);
            Mat src, dst;
            labels.convertTo(src, type);
            if (interpolation == INTER_LINEAR)
            {
                std::string reason; // cv::remap would refuse it without naming the argument
                try
                {
                    corrector->correctWithMotion(src, exampleMotion(), dst);
                }
                catch (const cv::Exception& e)
                {
                    reason = e.err;
                }
                EXPECT_EQ(0u, reason.find("src is of type")) << reason;
                continue;
            }
            corrector->correctWithMotion(labels, exampleMotion(), expected);
            corrector->correctWithMotion(src, exampleMotion(), dst);
            ASSERT_EQ(type, dst.type());
            dst.convertTo(found, expected.type());
            EXPECT_EQ(0, cvtest::norm(expected, found, NORM_INF));
            EXPECT_GT(cvtest::norm(labels, found, NORM_INF), 0);
        }
}

TEST(RSAckermann_CorrectorImageArguments, every_form_at_every_entry)
{
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(61, 47));
    camera.lineDelay = 1e-4;
    checkEveryForm(camera, entries(camera));
}

}} // namespace opencv_test::
