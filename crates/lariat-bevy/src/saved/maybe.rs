//! A component that may be absent, as a list of none or one: formats write a component without
//! fields like the absence of one.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Writes a component.
pub(crate) fn serialize<T: Serialize, S: Serializer>(component: &Option<T>, serializer: S) -> Result<S::Ok, S::Error> {
    component.as_slice().serialize(serializer)
}

/// Reads a component.
pub(crate) fn deserialize<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<T>, D::Error> {
    let mut list = Vec::<T>::deserialize(deserializer)?;
    let component = list.pop();
    if list.is_empty() { Ok(component) } else { Err(D::Error::custom("a component is there more than once")) }
}
