// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_LO_RANSAC_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_LO_RANSAC_HPP

#include "opencv2/core.hpp"
#include <cmath>

namespace cv { namespace rsackermann {

struct RansacOptions
{
    double confidence;
    int maxIterations;
    uint64 seed;
};

const double USEFUL_SAMPLES = 0.1; //!< of those without outliers

/** Smallest number of samples after which a useful one has been drawn with the given confidence.

Only one in ten samples without outliers is counted on: the others fall on the walls in another arrangement than the
solver takes, or noise spoils them.
@return at most maxIterations.
*/
inline int requiredIterations(int inliers, int size, int sampleSize, double confidence, int maxIterations)
{
    double useful = USEFUL_SAMPLES; // probability of one, drawn without replacement
    for (int i = 0; i < sampleSize; i++)
        useful *= std::max(inliers - i, 0) / double(size - i);
    const double needed = std::log(1 - std::min(confidence, 1 - 1e-12)) / std::log1p(-useful);
    return useful > 0 && needed < maxIterations ? std::max(1, cvCeil(needed)) : maxIterations;
}

/** Locally optimised RANSAC (algorithm 2 of @cite purkait2018minimal with local optimisation).

The Estimator knows the data and has
-   the type Model and the constant MAX_MODELS,
-   int size() const: number of data, and int sampleSize() const,
-   int generate(const int* sample, Model* models): hypotheses from a sample in ascending order,
-   double score(const Model&, double best, int& inliers): the lower the better; may stop early with any value above
    best,
-   void optimize(Model&): local optimisation.

@return whether there is a model at all.
*/
template <class Estimator>
bool loRansac(Estimator& estimator, const RansacOptions& options, typename Estimator::Model& bestModel,
              double& bestScore)
{
    const int size = estimator.size(), sampleSize = estimator.sampleSize();
    bestScore = DBL_MAX;
    if (size < sampleSize)
        return false;
    RNG rng(options.seed);
    AutoBuffer<int, 8> sample(sampleSize);
    typename Estimator::Model models[Estimator::MAX_MODELS];
    int required = options.maxIterations;
    for (int iteration = 0; iteration < required; iteration++)
    {
        // Insertion keeps the sample in ascending order and without repetition.
        for (int i = 0; i < sampleSize; i++)
        {
            int drawn = rng.uniform(0, size - i), place = 0;
            for (; place < i && drawn >= sample[place]; place++)
                drawn++;
            for (int j = i; j > place; j--)
                sample[j] = sample[j - 1];
            sample[place] = drawn;
        }
        const int count = estimator.generate(sample.data(), models);
        for (int i = 0; i < count; i++)
        {
            int inliers = 0;
            double score = estimator.score(models[i], bestScore, inliers);
            if (!(score < bestScore))
                continue;
            typename Estimator::Model optimized = models[i];
            estimator.optimize(optimized);
            int optimizedInliers = 0;
            const double optimizedScore = estimator.score(optimized, score, optimizedInliers);
            if (optimizedScore < score)
            {
                models[i] = optimized;
                score = optimizedScore;
                inliers = optimizedInliers;
            }
            bestScore = score;
            bestModel = models[i];
            required = requiredIterations(inliers, size, sampleSize, options.confidence, options.maxIterations);
        }
    }
    return bestScore < DBL_MAX;
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_LO_RANSAC_HPP
