//! Where results go: lent slices, fixed arrays, or vectors.
//!
//! The kernel allocates nothing. A function with a result of unbounded size takes a [`Store`]: a [`SliceStore`] over a
//! slice that the caller lends, an `ArrayVec`, or (feature `alloc`) a `Vec`. A store that is full answers [`BufferFull`];
//! nothing is lost silently.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use core::fmt;

/// The store cannot take one more item. Lend a larger slice and start again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BufferFull {
    /// Items it can hold.
    pub capacity: usize,
}

impl fmt::Display for BufferFull {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a buffer for {} items is full", self.capacity)
    }
}

impl core::error::Error for BufferFull {}

/// A growing list with a possible end, seen as a slice.
pub trait Store<T> {
    /// Appends an item.
    ///
    /// # Errors
    /// [`BufferFull`] where there is no room.
    fn push(&mut self, item: T) -> Result<(), BufferFull>;

    /// The items so far.
    fn items(&self) -> &[T];

    /// The items so far, to change in place.
    fn items_mut(&mut self) -> &mut [T];

    /// Forgets all items after the first `len`.
    fn shorten(&mut self, len: usize);
}

/// Where items go that are not looked at again: any [`Store`], or something that keeps less of them.
pub trait Sink<T> {
    /// Takes an item.
    ///
    /// # Errors
    /// [`BufferFull`] where there is no room.
    fn take(&mut self, item: T) -> Result<(), BufferFull>;
}

impl<T, X: Store<T>> Sink<T> for X {
    #[inline]
    fn take(&mut self, item: T) -> Result<(), BufferFull> {
        self.push(item)
    }
}

/// Appends to a list that is known to have room; unlike `push` it links no panic.
pub(crate) trait Keep<T> {
    fn keep(&mut self, item: T);
}

impl<T, const N: usize> Keep<T> for arrayvec::ArrayVec<T, N> {
    #[inline]
    fn keep(&mut self, item: T) {
        let kept = self.try_push(item).is_ok();
        debug_assert!(kept, "a list of {N} items is full");
    }
}

/// A [`Store`] in a slice that the caller lends.
#[derive(Debug)]
pub struct SliceStore<'a, T> {
    slots: &'a mut [T],
    len: usize,
}

impl<'a, T> SliceStore<'a, T> {
    /// An empty store over these slots; what they held is overwritten.
    pub fn new(slots: &'a mut [T]) -> Self {
        Self { slots, len: 0 }
    }

    /// The items, for as long as the slots were lent.
    pub fn into_items(self) -> &'a mut [T] {
        let len = self.len;
        self.slots.get_mut(..len).unwrap_or_default()
    }
}

impl<T> Store<T> for SliceStore<'_, T> {
    fn push(&mut self, item: T) -> Result<(), BufferFull> {
        let capacity = self.slots.len();
        let slot = self.slots.get_mut(self.len).ok_or(BufferFull { capacity })?;
        *slot = item;
        self.len += 1;
        Ok(())
    }

    fn items(&self) -> &[T] {
        self.slots.get(..self.len).unwrap_or_default()
    }

    fn items_mut(&mut self) -> &mut [T] {
        self.slots.get_mut(..self.len).unwrap_or_default()
    }

    fn shorten(&mut self, len: usize) {
        self.len = self.len.min(len);
    }
}

impl<T, const N: usize> Store<T> for arrayvec::ArrayVec<T, N> {
    fn push(&mut self, item: T) -> Result<(), BufferFull> {
        self.try_push(item).map_err(|_| BufferFull { capacity: N })
    }

    fn items(&self) -> &[T] {
        self
    }

    fn items_mut(&mut self) -> &mut [T] {
        self
    }

    fn shorten(&mut self, len: usize) {
        self.truncate(len);
    }
}

/// A [`Store`] that takes everything and keeps nothing: for results that the caller has no use for.
#[derive(Clone, Copy, Debug, Default)]
pub struct Forget;

impl<T> Store<T> for Forget {
    #[inline]
    fn push(&mut self, _: T) -> Result<(), BufferFull> {
        Ok(())
    }

    #[inline]
    fn items(&self) -> &[T] {
        &[]
    }

    #[inline]
    fn items_mut(&mut self) -> &mut [T] {
        &mut []
    }

    #[inline]
    fn shorten(&mut self, _: usize) {}
}

#[cfg(feature = "alloc")]
impl<T> Store<T> for Vec<T> {
    fn push(&mut self, item: T) -> Result<(), BufferFull> {
        Self::push(self, item);
        Ok(())
    }

    fn items(&self) -> &[T] {
        self
    }

    fn items_mut(&mut self) -> &mut [T] {
        self
    }

    fn shorten(&mut self, len: usize) {
        self.truncate(len);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_kept_where_nothing_is_wanted() {
        let mut store = Forget;
        assert_eq!(Store::push(&mut store, 7), Ok(()));
        assert_eq!(Store::<i32>::items(&store), []);
    }

    #[test]
    fn a_full_slice_says_so() {
        let mut slots = [0; 2];
        let mut store = SliceStore::new(&mut slots);
        assert_eq!(store.push(7), Ok(()));
        assert_eq!(store.push(8), Ok(()));
        assert_eq!(store.push(9), Err(BufferFull { capacity: 2 }));
        assert_eq!(store.items(), [7, 8]);
        store.shorten(1);
        assert_eq!(store.into_items(), [7]);
    }
}
