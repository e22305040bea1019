#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace rsphere {

// A hash table that many threads read and add to concurrently without waiting. The table never moves, changes
// or removes an entry. Key has hash(); Value is made from a key.
template <class Key, class Value>
class InsertOnce {
 public:
  explicit InsertOnce(unsigned logBuckets) : mask_((size_t{1} << logBuckets) - 1), buckets_(mask_ + 1) {}
  InsertOnce(const InsertOnce&) = delete;
  InsertOnce& operator=(const InsertOnce&) = delete;
  ~InsertOnce() {
    for (auto& bucket : buckets_)
      for (Node* node = bucket.load(std::memory_order_relaxed); node;) {
        Node* const next = node->next;
        delete node;
        node = next;
      }
  }

  // The value of the key, or null.
  Value* find(const Key& key) {
    return findFrom(buckets_[key.hash() & mask_].load(std::memory_order_acquire), key);
  }

  // The value of the key. If there is none, adds the one that make() returns as a unique pointer; that result
  // is discarded if another thread adds one first.
  template <class Make>
  Value& findOrAdd(const Key& key, Make make) {
    std::atomic<Node*>& bucket = buckets_[key.hash() & mask_];
    Node* first = bucket.load(std::memory_order_acquire);
    if (Value* value = findFrom(first, key)) return *value;
    auto node = std::make_unique<Node>(Node{key, make(), nullptr});
    for (;;) {
      node->next = first;
      if (bucket.compare_exchange_weak(first, node.get(), std::memory_order_release,
                                       std::memory_order_acquire)) {
        size_.fetch_add(1, std::memory_order_relaxed);
        return *node.release()->value;
      }
      if (Value* value = findFrom(first, key)) return *value;
    }
  }

  size_t size() const { return size_.load(std::memory_order_relaxed); }

 private:
  struct Node {
    Key key;
    std::unique_ptr<Value> value;
    Node* next;
  };
  static Value* findFrom(Node* node, const Key& key) {
    for (; node; node = node->next)
      if (node->key == key) return node->value.get();
    return nullptr;
  }

  size_t mask_;
  std::vector<std::atomic<Node*>> buckets_;
  std::atomic<size_t> size_{0};
};

}  // namespace rsphere
