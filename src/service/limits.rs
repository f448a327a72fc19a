//! Who may do how much ([`rates`]), and whose word on addresses is taken.

mod rates;

pub use rates::{Counted, RateLimits};

use super::Scope;
use crate::fault::Fault;
use crate::language::Text;
use axum::extract::{FromRequestParts, Request};
use axum::http::request::Parts;
use axum::http::{Extensions, HeaderMap};
use std::convert::Infallible;
use std::net::{IpAddr, Ipv6Addr, SocketAddr};

/// The address at the other end of a connection; the server puts it into each request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Peer(pub SocketAddr);

/// The address of whoever sent a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Client {
    /// The address; of IPv6 only the network, which one person has.
    pub address: IpAddr,
    /// Whether the request came from this machine, and not through a proxy.
    pub is_local: bool,
}

impl<S: Scope> FromRequestParts<S> for Client {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, scope: &S) -> Result<Self, Infallible> {
        Ok(scope.whole().proxies.client(peer(&parts.extensions), &parts.headers))
    }
}

/// The address at the other end; where there is no connection, as in a test, nobody in particular.
pub(super) fn peer(extensions: &Extensions) -> IpAddr {
    extensions.get::<Peer>().map_or(IpAddr::V6(Ipv6Addr::UNSPECIFIED), |peer| peer.0.ip().to_canonical())
}

/// The networks of reverse proxies whose word is taken.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Proxies(Vec<(IpAddr, u32)>);

impl Proxies {
    /// Reads the addresses and networks of an option.
    pub fn parse(option: &str, texts: &[String]) -> Result<Self, Fault> {
        let networks = texts.iter().map(|text| network(text).ok_or(text)).collect::<Result<_, _>>();
        networks.map(Self).map_err(|text| {
            Fault::new(Text::new(
                format!("the configuration: {option}: {text:?} is no address, and no network such as 10.0.0.0/8"),
                format!("設定の {option} の {text:?} は、アドレスでも 10.0.0.0/8 のような範囲でもありません"),
            ))
        })
    }

    pub(super) fn trusts(&self, address: IpAddr) -> bool {
        self.0.iter().any(|&(network, prefix)| prefix_of(address, prefix) == prefix_of(network, prefix))
    }

    /// Who sent a request.
    pub(super) fn client_of(&self, request: &Request) -> Client {
        self.client(peer(request.extensions()), request.headers())
    }

    /// The last address of the chain that no trusted proxy has: what stands left of it anybody could have written.
    fn client(&self, peer: IpAddr, headers: &HeaderMap) -> Client {
        let mut address = peer;
        let values = headers.get_all("x-forwarded-for").iter().filter_map(|value| value.to_str().ok());
        let chain: Vec<&str> = values.flat_map(|value| value.split(',')).map(str::trim).collect();
        let is_forwarded = !chain.is_empty() || headers.contains_key("forwarded");
        for hop in chain.into_iter().rev() {
            if !self.trusts(address) {
                break;
            }
            let Ok(before) = hop.parse::<IpAddr>() else { break };
            address = before.to_canonical();
        }
        let address = if address.is_ipv6() { prefix_of(address, 64).unwrap_or(address) } else { address };
        Client { address, is_local: peer.is_loopback() && !is_forwarded }
    }
}

fn network(text: &str) -> Option<(IpAddr, u32)> {
    let (address, prefix) = match text.split_once('/') {
        Some((address, prefix)) => (address, Some(prefix.parse().ok()?)),
        None => (text, None),
    };
    let address: IpAddr = address.trim().parse().ok()?;
    let bits = if address.is_ipv4() { 32 } else { 128 };
    let prefix = prefix.unwrap_or(bits);
    (prefix <= bits).then_some((address, prefix))
}

/// The first bits of an address; the rest is zero.
fn prefix_of(address: IpAddr, prefix: u32) -> Option<IpAddr> {
    match address {
        IpAddr::V4(v4) if prefix <= 32 => {
            let mask = u32::MAX.checked_shl(32 - prefix).unwrap_or(0);
            Some(IpAddr::V4((v4.to_bits() & mask).into()))
        }
        IpAddr::V6(v6) => {
            let mask = u128::MAX.checked_shl(128 - prefix).unwrap_or(0);
            Some(IpAddr::V6((v6.to_bits() & mask).into()))
        }
        IpAddr::V4(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn client(trusted: &[&str], peer: &str, forwarded: Option<&str>) -> Client {
        let trusted: Vec<String> = trusted.iter().map(|text| (*text).to_owned()).collect();
        let mut headers = HeaderMap::new();
        if let Some(chain) = forwarded {
            headers.insert("x-forwarded-for", chain.parse().expect("a header"));
        }
        Proxies::parse("trusted_proxies", &trusted)
            .expect("networks")
            .client(peer.parse().expect("an address"), &headers)
    }

    #[test]
    fn only_what_trusted_proxies_saw_is_believed() {
        let address = |trusted: &[&str], peer, chain| client(trusted, peer, chain).address.to_string();
        assert_eq!(address(&[], "192.0.2.1", Some("198.51.100.7")), "192.0.2.1");
        assert_eq!(address(&["127.0.0.1"], "127.0.0.1", Some("198.51.100.7")), "198.51.100.7");
        // The client wrote the first address itself.
        assert_eq!(address(&["10.0.0.0/8"], "10.1.2.3", Some("203.0.113.9, 198.51.100.7, 10.9.9.9")), "198.51.100.7");
        assert_eq!(address(&["10.0.0.0/8"], "10.1.2.3", Some("nonsense")), "10.1.2.3");
        assert_eq!(address(&["0.0.0.0/0"], "10.1.2.3", Some("198.51.100.7")), "198.51.100.7");
    }

    #[test]
    fn a_person_has_a_whole_ipv6_network() {
        let address = |peer| client(&[], peer, None).address.to_string();
        assert_eq!(address("2001:db8:1:2:3:4:5:6"), "2001:db8:1:2::");
        assert_eq!(address("192.0.2.77"), "192.0.2.77");
    }

    #[test]
    fn behind_a_proxy_nobody_is_local() {
        assert!(client(&[], "127.0.0.1", None).is_local);
        assert!(!client(&[], "127.0.0.1", Some("198.51.100.7")).is_local);
        assert!(!client(&[], "192.0.2.1", None).is_local);
    }

    #[test]
    fn what_is_no_network_is_a_fault() {
        for wrong in ["", "proxy.example", "10.0.0.0/33", "10.0.0.0/x"] {
            assert!(Proxies::parse("trusted_proxies", &[wrong.to_owned()]).is_err(), "{wrong}");
        }
    }
}
