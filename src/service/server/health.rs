//! Asking a service from outside its process whether it takes uploads, as a container's health check does.

use crate::service::clients::{Clients, causes};
use reqwest::Url;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};

/// Where a service that listens on an address says whether it takes uploads.
pub fn readiness_address(listen: SocketAddr) -> String {
    // "Every address" is where one listens; to be asked, this machine has one of them.
    let ip = match listen.ip() {
        IpAddr::V4(ip) if ip.is_unspecified() => IpAddr::V4(Ipv4Addr::LOCALHOST),
        IpAddr::V6(ip) if ip.is_unspecified() => IpAddr::V6(Ipv6Addr::LOCALHOST),
        ip => ip,
    };
    format!("http://{}/readyz", SocketAddr::new(ip, listen.port()))
}

/// Asks at this address.
///
/// # Errors
///
/// Why no upload is taken there, in the service's own words or those of the network.
pub async fn ready(address: &str) -> Result<(), String> {
    let url = Url::parse(address).map_err(|error| format!("{address}: {error}"))?;
    let clients = Clients::default();
    let answer = clients.of(&url)?.get(url.clone()).send().await.map_err(|error| causes(&error))?;
    if answer.status().is_success() {
        return Ok(());
    }
    Err(format!("{address} answered {}", answer.status()))
}

#[cfg(test)]
mod tests {
    use super::readiness_address;

    #[test]
    fn every_address_is_asked_at_this_machine() {
        for (listen, asked) in [
            ("127.0.0.1:8080", "http://127.0.0.1:8080/readyz"),
            ("0.0.0.0:80", "http://127.0.0.1:80/readyz"),
            ("[::]:8080", "http://[::1]:8080/readyz"),
            ("10.1.2.3:8080", "http://10.1.2.3:8080/readyz"),
        ] {
            assert_eq!(readiness_address(listen.parse().unwrap()), asked);
        }
    }
}
