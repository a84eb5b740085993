// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "edges.hpp"

namespace cv { namespace rsackermann {

static const double LEAST_SIGMAS = 2.5;     // of the noise of a step
static const double LEAST_STEP = 8;         // grey levels
static const double GATE = 1;               // pixels from the expected column
static const double STRAIGHT = 0.3;         // pixels, root mean square from a straight line
static const double LARGEST_SAGITTA = 0.02; // of the length

namespace {

// Links the edges of rows to chains and cuts these into straight or, if a lens has bent them, evenly curved pieces.
class EdgeChains
{
public:
    EdgeChains(const Mat& gray_, double noise_, int leastRows_)
        : gray(gray_), leastRows(std::max(leastRows_, 4)), noise(noise_), buffer(2 * gray_.cols), found(gray_.cols),
          foundCount(0), unused(NONE)
    {
        for (int row = 0; row < gray.rows; row++)
        {
            findRow(row);
            choose();
            follow(row);
            begin(row);
        }
        for (size_t i = 0; i < chains.size(); i++)
            end(chains[i]);
    }

    std::vector<EdgePiece> pieces;

private:
    struct Point
    {
        float column, step;
        int row, previous; // place of the chain's point before
    };
    struct Chain
    {
        float column, slope; // expected in the next row
        int count;           // points; 0: it has ended
        int first, last;     // places of points
        int missed;          // rows since the last one
        int found;           // edge of the present row
        bool rises;
    };
    enum { NONE = -1 };
    void findRow(int row)
    {
        const double noiseOfStep = 0.612; // with white noise of one grey level: the norm of the gradient's weights
        const double least = std::max(LEAST_STEP, LEAST_SIGMAS * noiseOfStep * noise);
        const uchar* const neighbours[] = {gray.ptr(std::max(row - 1, 0)), gray.ptr(row),
                                           gray.ptr(std::min(row + 1, gray.rows - 1))};
        foundCount = findExtremes(neighbours, gray.cols, least, buffer.data(), found.data());
    }

    // Each chain's nearest edge; of several chains the one that has more points gets it.
    void choose()
    {
        const float firstGate = 1.5; // lines up to the diagonal
        owners.assign(foundCount, NONE);
        int first = 0;
        for (size_t i = 0; i < chains.size(); i++)
        {
            Chain& c = chains[i];
            c.found = NONE;
            while (first < foundCount && found[first].column < c.column - firstGate)
                first++;
            float nearest = float(c.count == 1 ? firstGate : GATE);
            for (int j = first; j < foundCount && found[j].column <= c.column + nearest; j++)
                if ((found[j].step > 0) == c.rises && std::abs(found[j].column - c.column) <= nearest)
                {
                    nearest = std::abs(found[j].column - c.column);
                    c.found = j;
                }
            if (c.found == NONE)
                continue;
            int& owner = owners[c.found];
            if (owner == NONE || chains[owner].count < c.count)
            {
                if (owner != NONE)
                    chains[owner].found = NONE;
                owner = int(i);
            }
            else
                c.found = NONE;
        }
    }

    // A filter whose memory grows with the chain up to some rows. Chains that have ended have no points.
    void follow(int row)
    {
        const int longestGap = 2, memory = 12;
        for (size_t i = 0; i < chains.size(); i++)
        {
            Chain& c = chains[i];
            if (c.found == NONE)
            {
                if (++c.missed > longestGap)
                {
                    end(c);
                    points[c.first].previous = unused;
                    unused = c.last;
                    c.count = 0;
                    continue;
                }
            }
            else
            {
                const EdgePoint& e = found[c.found];
                const float n = float(std::min(c.count + 1, memory)), error = e.column - c.column;
                c.column += 2 * (2 * n - 1) / (n * (n + 1)) * error;
                c.slope += 6 / (n * (n + 1)) * error;
                c.last = addPoint(e, row, c.last);
                c.count++;
                c.missed = 0;
            }
            c.column += c.slope;
        }
    }

    // Written to its place number by number: a copy of what has just been written so would wait for it.
    int addPoint(const EdgePoint& edge, int row, int previous)
    {
        if (unused == NONE)
        {
            unused = int(points.size());
            points.push_back({0, 0, 0, NONE});
        }
        const int place = unused;
        Point& p = points[place];
        unused = p.previous;
        p.column = edge.column;
        p.step = edge.step;
        p.row = row;
        p.previous = previous;
        return place;
    }

    // Edges that no chain has begin one; chains are kept from left to right.
    void begin(int row)
    {
        size_t kept = 0;
        for (size_t i = 0; i < chains.size(); i++)
        {
            if (chains[i].count == 0)
                continue;
            if (kept != i)
                chains[kept] = chains[i];
            for (size_t j = kept++; j > 0 && chains[j].column < chains[j - 1].column; j--) // nearly sorted
                std::swap(chains[j], chains[j - 1]);
        }
        chains.resize(kept);
        next.clear();
        size_t i = 0;
        for (int j = 0; j < foundCount; j++)
        {
            if (owners[j] != NONE)
                continue;
            const EdgePoint& e = found[j];
            while (i < kept && chains[i].column < e.column)
                next.push_back(chains[i++]);
            const int point = addPoint(e, row, NONE);
            next.push_back({e.column, 0, 1, point, point, 0, NONE, e.step > 0});
        }
        if (next.empty())
            return;
        next.insert(next.end(), chains.begin() + i, chains.end());
        next.swap(chains);
    }

    void end(const Chain& ended)
    {
        if (ended.count < leastRows)
            return;
        chain.resize(ended.count);
        for (int i = ended.last, k = ended.count - 1; k >= 0; i = points[i].previous, k--)
            chain[k] = points[i];
        const Point& origin = chain[0];
        sums.resize(chain.size() + 1);
        ParabolaSums sum;
        for (size_t i = 0; i < chain.size(); i++)
        {
            sums[i] = sum;
            sum.add(chain[i].row - origin.row, chain[i].column - origin.column, 1);
        }
        sums[chain.size()] = sum;
        cut(0, int(chain.size()), 0);
    }

    // About the centre of the rows.
    ParabolaFit fit(int begin, int end, bool isCurved) const
    {
        const double centre = (chain[begin].row + chain[end - 1].row) / 2. - chain[0].row;
        return sums[end].since(sums[begin], centre).fit(isCurved);
    }

    void cut(int begin, int end, int depth)
    {
        const int deepest = 12, candidates = 32;
        const double significant = 32; // square of four sigmas, for rows that share pixels
        const int rowsSpanned = chain[end - 1].row - chain[begin].row + 1;
        if (end - begin < leastRows * 2 / 3 || rowsSpanned < leastRows || depth > deepest)
            return;
        double step = 0;
        for (int i = begin; i < end; i++)
            step += std::abs(chain[i].step);
        step /= end - begin;
        const double allowed = STRAIGHT * STRAIGHT + noise * noise / (step * step);
        const ParabolaFit straight = fit(begin, end, false), curved = fit(begin, end, true);
        const bool isBetter = (end - begin) * (straight.squares - curved.squares) > significant * curved.squares,
                   isBent = isBetter && curved.squares <= allowed &&
                            std::abs(curved.curvature) * rowsSpanned / 4 < LARGEST_SAGITTA;
        if (isBent || straight.squares <= allowed)
            return add(begin, end, isBent);
        // Where two straight lines fit best.
        const int spacing = std::max((end - begin) / candidates, 1);
        int best = NONE;
        double least = DBL_MAX;
        for (int k = begin + 3; k <= end - 3; k += spacing)
        {
            const double squares = (k - begin) * fit(begin, k, false).squares + (end - k) * fit(k, end, false).squares;
            if (squares < least)
            {
                least = squares;
                best = k;
            }
        }
        if (best == NONE)
            return;
        cut(begin, best, depth + 1);
        cut(best, end, depth + 1);
    }

    void add(int begin, int end, bool isCurved)
    {
        const ParabolaFit f = fit(begin, end, isCurved);
        const EdgePiece piece = {
            double(chain[begin].row), double(chain[end - 1].row), chain[0].column + f.middle, f.slope, f.curvature,
            chain[begin].step > 0};
        pieces.push_back(piece);
    }

    const Mat& gray;
    int leastRows;
    double noise;
    std::vector<short> buffer;
    std::vector<EdgePoint> found; // in the present row, the first foundCount of them
    int foundCount;
    std::vector<int> owners;
    std::vector<Point> points, chain; // of all chains, of one that has ended
    int unused;                       // place of the last of the points of chains that have ended
    std::vector<Chain> chains, next;
    std::vector<ParabolaSums> sums; // over the points before one
};

} // namespace

std::vector<EdgePiece> findEdges(const Mat& gray, double noise, int leastRows)
{
    return EdgeChains(gray, noise, leastRows).pieces;
}

}} // namespace cv::rsackermann
