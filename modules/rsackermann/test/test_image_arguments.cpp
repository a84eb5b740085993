// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_image_arguments.hpp"

namespace opencv_test { namespace {

std::vector<Entry> entries(const RollingShutterCamera& camera)
{
    std::vector<Entry> list;
    list.push_back({"detectSegments", true, [](InputArray image) {
                        Mat found;
                        detectSegments(image, found);
                    }});
    list.push_back({"estimateFromImage", true, [camera](InputArray image) {
                        Mat found, labels;
                        AckermannEstimator::create(camera)->estimateFromImage(image, found, labels);
                    }});
    return list;
}

TEST(RSAckermann_ImageArguments, every_type_at_every_entry)
{
    const RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(61, 47));
    checkEveryType(camera, entries(camera));
}

TEST(RSAckermann_ImageArguments, every_form_at_every_entry)
{
    const RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(61, 47));
    checkEveryForm(camera, entries(camera));
}

}} // namespace opencv_test::
