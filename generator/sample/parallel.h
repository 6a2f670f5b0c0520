// Loops that the threads of the program share. No result depends on how many there are.
#pragma once
#include <cstddef>
#include <functional>

namespace lamella {

/// From now on loops are shared by so many threads, at least 1, which is what there is before the first call.
void use_threads(int count);
int threads_in_use();

/// Cells of a piece: small enough to share out evenly, large enough for threads not to wait for each other.
inline constexpr std::size_t kCellsOfPiece = 1024;

/// Calls work(begin, end) for all of [0, count) cut into pieces of `piece`, the last one shorter, each once, from any thread
/// and in any order, and returns when all are done. Pieces write what no other piece touches. What the first of the pieces
/// that throw has thrown is thrown here.
void for_pieces(std::size_t count, std::size_t piece,
                const std::function<void(std::size_t begin, std::size_t end)>& work);

}  // namespace lamella
