// GiNaC, symbolic metrics: expressions, of which each component is brought to lowest terms by `normal`.
// Arguments: a file of constants as in peer.py, the file of values, the rows of the metric.
#include <ginac/ginac.h>
#include <array>
#include <cctype>
#include <ctime>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>

using namespace GiNaC;
using Indices = std::vector<int>;
using Components = std::map<Indices, ex>;

static int n;
static std::map<std::array<int, 3>, int> c;
static double spent = 0;

static std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts;
    std::stringstream stream(text);
    for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
    return parts;
}

// Numerator and denominator, without negative powers and spaces.
static std::string text_of(const ex& value) {
    const ex parts = value.numer_denom();
    std::ostringstream out;
    out << "(" << parts.op(0) << ")/(" << parts.op(1) << ")";
    std::string text;
    for (char letter : out.str())
        if (!std::isspace(static_cast<unsigned char>(letter))) text += letter;
    return text;
}

static Components stage(const char* path, const std::string& name, const std::function<Components()>& sums) {
    const std::clock_t start = std::clock();
    Components found;
    for (auto& [at, sum] : sums()) {
        const ex value = sum.normal();
        if (!value.is_zero()) found[at] = value;
    }
    spent += double(std::clock() - start) / CLOCKS_PER_SEC;
    std::cout << "RESULT " << name << " " << spent << " " << found.size() << std::endl;
    std::ofstream file(path, std::ios::app);
    for (auto& [at, value] : found) {
        file << name;
        for (int i : at) file << " " << i + 1;
        file << " " << text_of(value) << "\n";
    }
    return found;
}

int main(int, char** words) {
    std::ifstream file(words[1]);
    file >> n;
    for (int i, j, k, v; file >> i >> j >> k >> v;) {
        c[{i - 1, j - 1, k - 1}] = v;
        c[{i - 1, k - 1, j - 1}] = -v;
    }
    std::map<std::string, symbol> letters;
    matrix g(n, n);
    const auto rows = split(words[3], ';');
    for (int i = 0; i < n; i++) {
        const auto row = split(rows[i], ',');
        for (int j = 0; j < n; j++) {
            if (row[j] == "0") continue;
            g(i, j) = letters.emplace(row[j], symbol(row[j])).first->second;
        }
    }

    const Components affinities = stage(words[2], "affinities", [&] {
        const matrix inverse = g.inverse();
        Components lower, sums;
        for (auto& [at, v] : c)
            for (int p = 0; p < n; p++)
                if (!g(p, at[0]).is_zero()) lower[{p, at[1], at[2]}] += v * g(p, at[0]);
        const auto of = [&](int p, int j, int k) {
            const auto found = lower.find({p, j, k});
            return found == lower.end() ? ex(0) : found->second;
        };
        for (int p = 0; p < n; p++)
            for (int j = 0; j < n; j++)
                for (int k = 0; k < n; k++) {
                    const ex koszul = (of(p, j, k) - of(j, k, p) + of(k, p, j)) / 2;
                    if (koszul.is_zero()) continue;
                    for (int i = 0; i < n; i++)
                        if (!inverse(i, p).is_zero()) sums[{i, j, k}] += inverse(i, p) * koszul;
                }
        return sums;
    });
    const Components curvature = stage(words[2], "curvature", [&] {
        std::map<std::array<int, 2>, std::vector<std::pair<int, ex>>> row;
        for (auto& [at, v] : affinities) row[{at[1], at[2]}].push_back({at[0], v});
        Components sums;
        for (int k = 0; k < n; k++)
            for (int l = k + 1; l < n; l++)
                for (int j = 0; j < n; j++) {
                    for (auto& [m, v] : row[{l, j}])
                        for (auto& [i, w] : row[{k, m}]) sums[{i, j, k, l}] += v * w;
                    for (auto& [m, v] : row[{k, j}])
                        for (auto& [i, w] : row[{l, m}]) sums[{i, j, k, l}] -= v * w;
                    for (int m = 0; m < n; m++) {
                        const auto bracket = c.find({m, k, l});
                        if (bracket == c.end()) continue;
                        for (auto& [i, w] : row[{m, j}]) sums[{i, j, k, l}] -= bracket->second * w;
                    }
                }
        return sums;
    });
    stage(words[2], "ricci", [&] {
        Components sums;
        for (auto& [at, v] : curvature) {
            if (at[0] == at[2]) sums[{at[1], at[3]}] += v;
            if (at[0] == at[3]) sums[{at[1], at[2]}] -= v;
        }
        return sums;
    });
}
