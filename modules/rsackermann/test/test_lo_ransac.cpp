// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "../src/single/lo_ransac.hpp"

namespace opencv_test { namespace {

//! Lines y = a x + b through points, two a sample.
struct LineEstimator
{
    typedef Vec2d Model;
    enum { MAX_MODELS = 1 };

    std::vector<Point2d> points;
    int samples, optimizations;
    bool ascending;

    LineEstimator() : samples(0), optimizations(0), ascending(true) {}

    int size() const { return (int)points.size(); }
    int sampleSize() const { return 2; }

    int generate(const int* sample, Model* models)
    {
        samples++;
        ascending = ascending && sample[0] >= 0 && sample[0] < sample[1] && sample[1] < size();
        const Point2d &p = points[sample[0]], &q = points[sample[1]];
        models[0][0] = (q.y - p.y) / (q.x - p.x);
        models[0][1] = p.y - models[0][0] * p.x;
        return q.x != p.x;
    }

    double score(const Model& m, double best, int& inliers) const
    {
        double sum = 0;
        inliers = 0;
        for (size_t i = 0; i < points.size() && sum < best; i++)
        {
            const double r = m[0] * points[i].x + m[1] - points[i].y;
            inliers += std::abs(r) < 0.1;
            sum += std::min(r * r, 0.01);
        }
        return sum;
    }

    void optimize(Model&) { optimizations++; }
};

//! Points on y = 2 x - 1 and outliers.
LineEstimator line(int inliers, int outliers)
{
    RNG rng(3);
    LineEstimator estimator;
    for (int i = 0; i < inliers + outliers; i++)
    {
        const double x = rng.uniform(-10., 10.);
        estimator.points.push_back(Point2d(x, i < inliers ? 2 * x - 1 : rng.uniform(-20., 20.)));
    }
    return estimator;
}

RansacOptions ransacOptions()
{
    RansacOptions options;
    options.confidence = 0.99;
    options.maxIterations = 2000;
    options.seed = 1;
    return options;
}

TEST(RSAckermann_LoRansac, finds_the_consensus)
{
    for (int outliers = 0; outliers <= 160; outliers += 40)
    {
        LineEstimator estimator = line(40, outliers);
        Vec2d model;
        double score = -1;
        ASSERT_TRUE(loRansac(estimator, ransacOptions(), model, score));
        EXPECT_LT(cv::norm(model - Vec2d(2, -1)), 1e-9) << outliers;
        int inliers;
        EXPECT_EQ(estimator.score(model, DBL_MAX, inliers), score);
        EXPECT_TRUE(estimator.ascending);
        EXPECT_GT(estimator.optimizations, 0);
        EXPECT_LE(estimator.optimizations, estimator.samples);
    }
}

TEST(RSAckermann_LoRansac, fewer_outliers_need_fewer_samples)
{
    Vec2d model;
    double score;
    LineEstimator clean = line(100, 0), mixed = line(50, 50), hopeless = line(3, 200);
    loRansac(clean, ransacOptions(), model, score);
    loRansac(mixed, ransacOptions(), model, score);
    loRansac(hopeless, ransacOptions(), model, score);
    EXPECT_LT(clean.samples, mixed.samples);
    EXPECT_LT(mixed.samples, hopeless.samples);
    EXPECT_EQ(ransacOptions().maxIterations, hopeless.samples);
}

TEST(RSAckermann_LoRansac, too_few_data)
{
    LineEstimator estimator = line(1, 0);
    Vec2d model;
    double score;
    EXPECT_FALSE(loRansac(estimator, ransacOptions(), model, score));
    EXPECT_EQ(0, estimator.samples);

    LineEstimator vertical;
    vertical.points.assign(5, Point2d(1, 2));
    EXPECT_FALSE(loRansac(vertical, ransacOptions(), model, score)) << "no sample has a model";
}

TEST(RSAckermann_LoRansac, same_seed_same_result)
{
    Vec2d models[2];
    double score;
    for (int i = 0; i < 2; i++)
    {
        LineEstimator estimator = line(30, 60);
        loRansac(estimator, ransacOptions(), models[i], score);
    }
    EXPECT_EQ(models[0], models[1]);
}

// All pairs come up, about equally often.
TEST(RSAckermann_LoRansac, samples_are_uniform)
{
    struct Counter
    {
        typedef int Model;
        enum { MAX_MODELS = 1 };
        int counts[6][6];
        Counter() { memset(counts, 0, sizeof(counts)); }
        int size() const { return 6; }
        int sampleSize() const { return 2; }
        int generate(const int* sample, int*)
        {
            counts[sample[0]][sample[1]]++;
            return 0;
        }
        double score(const int&, double, int&) const { return 0; }
        void optimize(int&) {}
    } counter;
    RansacOptions options = ransacOptions();
    options.maxIterations = 15000;
    int model = 0;
    double score;
    EXPECT_FALSE(loRansac(counter, options, model, score));
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
        {
            if (i < j)
            {
                EXPECT_NEAR(1000, counter.counts[i][j], 150) << i << " " << j;
            }
            else
            {
                EXPECT_EQ(0, counter.counts[i][j]);
            }
        }
}

TEST(RSAckermann_LoRansac, requiredIterations)
{
    const int most = 100000;
    EXPECT_EQ(most, requiredIterations(0, 100, 4, 0.99, most));
    EXPECT_EQ(most, requiredIterations(3, 100, 4, 0.99, most)) << "not enough inliers for a sample";
    EXPECT_EQ(1, requiredIterations(50, 100, 4, 0, most));
    for (int inliers = 10; inliers < 100; inliers += 10)
    {
        const int needed = requiredIterations(inliers, 100, 4, 0.99, most);
        EXPECT_GE(needed, requiredIterations(inliers + 10, 100, 4, 0.99, most));
        EXPECT_GE(needed, requiredIterations(inliers, 100, 3, 0.99, most));
        EXPECT_LE(needed, requiredIterations(inliers, 100, 4, 0.999, most));
        EXPECT_EQ(std::min(needed, 77), requiredIterations(inliers, 100, 4, 0.99, 77));
        // at least the textbook's number for samples that are all useful
        EXPECT_GE(needed,
                  std::min(double(most), std::floor(std::log(0.01) / std::log(1 - std::pow(inliers / 100., 4)))));
    }
    EXPECT_LE(requiredIterations(100, 100, 4, 1, most), most) << "certainty isn't to be had";
}

}} // namespace
